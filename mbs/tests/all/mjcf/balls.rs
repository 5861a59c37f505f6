//! MJCF: springs and dampers of ball joints and free joints.

use super::{agrees, turns};

#[test]
fn a_time_and_a_damping_ratio_of_a_ball_follow_from_the_mean_of_what_it_moves() {
    // the ball is rotated by the rotation vector (0.2, 0.1, 0) [rad] and has a rate of 0.5 rad/s about z
    let model = r#"<mujoco><worldbody><body name="b" pos="0 0 1"><joint name="ball" type="ball" springdamper="0.2 1"/><geom type="box" pos="0 0 -0.2" size="0.05 0.1 0.2" mass="2"/></body></worldbody>
<keyframe><key name="on" qpos="QPOS" qvel="QVEL"/></keyframe></mujoco>"#;
    let model = model.replace("QPOS", KEY[0]).replace("QVEL", KEY[1]);
    turns(&model, "b", RIGHT);
}

/// State of the ball joint with a given damping ratio, in the coordinates of the file.
const KEY: [&str; 2] = [
    "0.9937565077045984 0.09979179683625425 0.049895898418127124 0.0",
    "-0.04958437376078141 0.09916874752156282 0.4875519966052396",
];
/// Angular acceleration of the ball joint with a given damping ratio [rad/s²].
const RIGHT: [f64; 3] = [-8.95344183343061, -1.7383496680042083, -12.48438525854519];

#[test]
fn a_ball_between_moving_bodies_has_a_moment_against_the_relative_turn() {
    agrees(
        r#"<mujoco><worldbody>
<body pos="0 0 1"><joint name="h" axis="1 2 0"/><geom type="box" size=".1 .2 .3" mass="2"/>
<body name="b" pos="0.2 0.1 0.5"><joint name="jj" type="ball" damping="0.7" stiffness="3" pos="0.1 0 0"/><geom type="box" size=".1 .2 .3" mass="1" pos="0.3 0.2 0.1" euler="20 30 40"/>
<body pos="0 0 1"><joint name="k" axis="0 1 0" springdamper="0.3 0.5"/><geom type="box" size=".1 .2 .3" mass="2"/></body></body></body></worldbody>
<keyframe><key name="on" qpos="0.2 0.9 0.1 0.2 0.3 0.4" qvel="0.3 0.4 0.5 -0.6 0.7"/></keyframe></mujoco>"#,
        &[("h", 13.83225277487506), ("k", -21.183838282885286)],
    );
}

#[test]
fn a_free_joint_has_one_stiffness_and_one_damping_for_all_six() {
    let model = r#"<mujoco><worldbody>
<body name="b" pos="0.2 0.1 0.5" euler="10 20 30"><joint name="jj" type="free" springdamper="0.2 1"/><geom type="box" size=".1 .2 .3" mass="1" pos="0.3 0.2 0.1" euler="20 30 40"/>
<body pos="0 0 1"><joint name="k" axis="0 1 0" armature="0.3" /><geom type="box" size=".1 .2 .3" mass="2"/></body></body></worldbody>
<keyframe><key name="on" qpos="0.3 0.2 0.9 0.9 0.1 0.2 0.3 0.4" qvel="0.3 0.2 0.1 0.4 -0.5 0.6 -0.7"/></keyframe></mujoco>"#;
    turns(model, "b", [-9.305714507398186, 5.8257785843823555, -16.602210794291654]);
    agrees(model, &[("k", -0.7873853003971151)]);
}
