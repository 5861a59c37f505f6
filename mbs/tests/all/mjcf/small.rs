//! MJCF: the smallest model of each kind, by closed forms.

use super::{agrees, turns};

use mbs_import::{ImportOptions, import};

/// Model of a wheel or a wagon with a joint, further elements beside the world, and a keyframe.
fn one(joint: &str, geom: &str, extra: &str, key: &str) -> String {
    format!(
        r#"<mujoco><compiler angle="radian"/><worldbody><body name="b" pos="0 0 1"><joint name="j" {joint}/><geom {geom}/></body></worldbody>
{extra}<keyframe><key name="on" {key}/></keyframe></mujoco>"#
    )
}

#[test]
fn a_spring_of_three_numbers_pushes_by_k_x_plus_an_even_and_a_cubic_term() {
    let wagon = r#"type="box" size="0.1 0.1 0.1" mass="2""#;
    // the force -(100 x + 400 x²) - (2 + 3 |v|) v acts on 2 kg
    let way = r#"type="slide" axis="1 0 0" stiffness="100 400" damping="2 3""#;
    agrees(&one(way, wagon, "", r#"qpos="0.1" qvel="-0.5""#), &[("j", -6.125)]);
    // the force 50 · 0.2 - 20 · 0.04 + 300 · 0.008 acts on 2 kg
    let way = r#"type="slide" axis="1 0 0" stiffness="50 20 300""#;
    agrees(&one(way, wagon, "", r#"qpos="-0.2""#), &[("j", 5.8)]);
}

#[test]
fn motors_of_one_joint_and_of_one_tendon_are_limited_together() {
    // J = 6 (0.2² + 0.1²)/3 = 0.1 kg m²; the torques of 2.4 and 1.6 N m are limited to 3 N m
    let motors = r#"<actuator><motor joint="j" gear="4"/><motor joint="j" gear="2"/></actuator>"#;
    let turret = r#"type="box" size="0.2 0.1 0.1" mass="6""#;
    let joint = r#"axis="0 0 1" actuatorfrcrange="-2 3""#;
    agrees(&one(joint, turret, motors, r#"ctrl="0.6 0.8""#), &[("j", 30.0)]);
    // J = 25 · 0.2²/2 = 0.5 kg m²; the tendon's 3 N are limited to 1.5 N, times the gear 4 and the coefficient 0.5
    let winch = r#"<tendon><fixed name="rope" actuatorfrcrange="-1.5 1.5"><joint joint="j" coef="0.5"/></fixed></tendon>
<actuator><motor tendon="rope" gear="4"/></actuator>"#;
    let drum = r#"type="cylinder" size="0.2 0.1" mass="25""#;
    agrees(&one(r#"axis="0 0 1""#, drum, winch, r#"ctrl="3""#), &[("j", 6.0)]);
}

#[test]
fn drag_of_a_geared_motor_is_in_the_rate_of_the_joint() {
    // the drag torque 4 (0.5 · 2 + 0.25 · 4 + 0.125 · 8) acts on the inertia J = 10 · 0.2²/2 kg m²
    let motor = r#"<actuator><motor joint="j" gear="2" damping="0.5 0.25 0.125"/></actuator>"#;
    let wheel = r#"type="cylinder" size="0.2 0.05" mass="10""#;
    agrees(&one(r#"axis="0 0 1""#, wheel, motor, r#"qvel="-2""#), &[("j", 60.0)]);
}

#[test]
fn a_motor_keeps_its_range_beside_a_servo_that_inherits_one() {
    let model = r#"<mujoco><compiler angle="radian"/><default><position kp="100" inheritrange="1"/><motor ctrlrange="-20 20"/></default>
<worldbody><body pos="0 0 1"><joint name="knee" axis="0 1 0" range="0.2 1.6"/><geom type="box" pos="0.15 0 0" size="0.15 0.02 0.02" mass="1"/></body></worldbody>
<actuator><motor joint="knee"/></actuator><keyframe><key name="on" qpos="0.9" ctrl="5"/></keyframe></mujoco>"#;
    // the knee has the acceleration (5 + m g l cos q)/J
    let inertia = (0.15_f64 * 0.15 + 0.02 * 0.02) / 3.0 + 0.15 * 0.15;
    let expected = (5.0 + 9.81 * 0.15 * 0.9_f64.cos()) / inertia;
    agrees(model, &[("knee", expected)]);
}

#[test]
fn a_body_that_stands_needs_no_force_against_gravity() {
    let model = r#"<mujoco><worldbody><body gravcomp="1"><geom type="box" size="0.1 0.1 0.1"/>
<body pos="0 0 0.2" gravcomp="1"><joint name="pivot" axis="0 1 0"/><geom type="box" pos="0.2 0 0" size="0.2 0.02 0.02" mass="1"/></body></body></worldbody>
<keyframe><key name="on" qpos="0.3" qvel="0.5"/></keyframe></mujoco>"#;
    agrees(model, &[("pivot", 0.0)]);
}

#[test]
fn a_damped_free_body_has_a_moment_against_its_turn_and_a_force_against_its_velocity() {
    // the body is rotated by 0.9 rad about x and has a rate of 2 rad/s about y; Euler's equations have the moment -w, with the angular velocity
    // w
    let (sine, cosine) = 0.9_f64.sin_cos();
    let model = r#"<mujoco><worldbody><body name="b" pos="0 0 1"><joint type="free" damping="1"/><geom type="box" size="0.1 0.2 0.05" mass="1"/></body></worldbody>
<keyframe><key name="on" qpos="0 0 1 HALF_COSINE HALF_SINE 0 0" qvel="0 0 0 0 Y Z"/></keyframe></mujoco>"#;
    let (half_sine, half_cosine) = 0.45_f64.sin_cos();
    let model = [
        ("HALF_COSINE", half_cosine),
        ("HALF_SINE", half_sine),
        ("Y", 2.0 * cosine),
        ("Z", -2.0 * sine),
    ]
    .iter()
    .fold(model.to_owned(), |text, (word, x)| text.replace(word, &format!("{x:?}")));
    let [a, b, c] = [0.2 * 0.2 + 0.05 * 0.05, 0.1 * 0.1 + 0.05 * 0.05, 0.1 * 0.1 + 0.2 * 0.2]
        .map(|square| square / 3.0);
    let [y, z] = [2.0 * cosine, -2.0 * sine];
    let own = [(b - c) * y * z / a, -y / b, -z / c];
    let expected = [own[0], cosine * own[1] - sine * own[2], sine * own[1] + cosine * own[2]];
    turns(&model, "b", expected);
}

#[test]
fn a_negative_moment_is_refused_where_it_is_written_and_one_of_zero_is_raised() {
    let model = |settings: &str, inertia: &str| {
        format!(
            r#"<mujoco><compiler {settings}/><worldbody><body name="plate"><joint axis="0 0 1"/><inertial pos="0 0 0" mass="2" {inertia}/></body></worldbody></mujoco>"#
        )
    };
    let read = |settings: &str, inertia: &str| {
        let text = model(settings, inertia);
        import(text.as_bytes(), "plate.xml", &ImportOptions::default())
    };
    let bound = r#"boundinertia="0.01""#;
    let refused = read(bound, r#"fullinertia="0.08 0.08 -0.02 0 0 0""#).expect_err("negative");
    assert!(refused.render().contains("[-0.02, 0.08, 0.08]"), "{}", refused.render());
    for zero in [r#"fullinertia="0.08 0.08 0 0 0 0""#, r#"diaginertia="0.08 0.08 -0.02""#] {
        let raised = read(bound, zero).unwrap_or_else(|error| panic!("{}", error.render()));
        assert!(raised.text.contains("inertia = [0.08, 0.08, 0.01,"), "{}", raised.text);
    }
    // the raised inertia violates the triangle inequality: the message shows the values of the file
    let refused = read(bound, r#"fullinertia="0.3 0.08 0 0 0 0""#).expect_err("of no body");
    let says = refused.render();
    assert!(says.contains("[0.0, 0.08, 0.3]") && says.contains("[0.01, 0.08, 0.3]"), "{says}");
}
