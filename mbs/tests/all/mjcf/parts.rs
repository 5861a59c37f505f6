//! MJCF: models that attach others.

use super::{ImportOptions, compare, of_joint, scene_text};
use crate::common::files::scratch;

/// Compares accelerations of joints of a model that attaches another model.
fn agrees(folder: &str, [model, part]: [&str; 2], expected: &[(&str, f64)]) {
    let folder = scratch(folder);
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("part.xml"), part).expect("a file");
    let options = ImportOptions { folder: Some(folder), ..ImportOptions::default() };
    let outputs = expected.iter().map(|(joint, x)| (of_joint(joint), vec![*x]));
    compare(scene_text(model, options), &outputs.collect::<Vec<_>>());
}

#[test]
fn an_attached_body_stands_in_its_place_under_names_with_the_prefix() {
    let part = r#"<mujoco><worldbody><body name="link"><joint name="hinge" axis="0 1 0"/><geom type="box" pos="0.1 0 0" size="0.1 0.02 0.02" mass="0.5"/></body></worldbody></mujoco>"#;
    let model = r#"<mujoco><asset><model name="part" file="part.xml"/></asset><worldbody><body pos="0 0 1"><joint name="turn" axis="0 0 1"/><geom type="box" size="0.1 0.1 0.02" mass="1"/>
<frame pos="0.1 0 0"><attach model="part" body="link" prefix="left_"/></frame></body></worldbody>
<keyframe><key name="on" qpos="0.2 0.5" qvel="0.3 -0.4"/></keyframe></mujoco>"#;
    let expected = [("turn", -0.048394879813694384), ("left_hinge", 63.85969132163878)];
    agrees("mjcf-attach", [model, part], &expected);
}

#[test]
fn an_attached_model_keeps_its_defaults_and_its_units_and_brings_its_tendons_and_actuators() {
    let part = r#"<mujoco model="part"><compiler angle="radian" eulerseq="zyx"/><default><geom density="500"/><joint damping="0.3"/><default class="x"><joint armature="0.1"/></default></default>
<worldbody><geom name="floor" size=".3" pos="0 0 5"/><body name="link" pos="0.1 0 0" euler="0.1 0.2 0.3"><joint name="hinge" axis="0 1 0" range="-1 1" class="x"/><geom type="box" pos="0.1 0 0" size="0.1 0.02 0.02"/><body name="tip" pos="0.3 0 0"><joint name="h2" axis="1 0 0" ref="0.2"/><geom size=".05" pos="0 .1 0"/><site name="s"/></body></body><body name="other"><joint name="oj"/><geom size=".1"/></body></worldbody>
<tendon><fixed name="t" stiffness="3"><joint joint="hinge" coef="2"/><joint joint="h2" coef="1"/></fixed><fixed name="t2" stiffness="3"><joint joint="hinge" coef="2"/><joint joint="oj" coef="1"/></fixed></tendon>
<actuator><motor name="m" joint="hinge" gear="2"/><position tendon="t" kp="3"/><motor joint="oj"/></actuator>
</mujoco>"#;
    let model = r#"<mujoco model="whole"><default><geom density="2000"/><joint damping="7"/></default><asset><model name="part" file="part.xml"/></asset>
<worldbody><body name="base" pos="0 0 1"><joint name="turn" axis="0 0 1" range="-100 100"/><geom type="box" size="0.1 0.1 0.02" mass="1"/><frame pos="0.1 0 0" euler="0 90 0"><attach model="part" body="link" prefix="left_"/></frame></body></worldbody>
<keyframe><key name="on" qpos=".1 .2 .3" qvel=".4 .5 .6" ctrl=".7 .8"/></keyframe></mujoco>"#;
    agrees(
        "mjcf-attach-0",
        [model, part],
        &[
            ("turn", -583.41895778746),
            ("left_hinge", -68.19434918751243),
            ("left_h2", -1544.9119147767342),
        ],
    );
    let model = r#"<mujoco model="whole"><default><geom density="2000"/><joint damping="7"/></default><asset><model name="part" file="part.xml"/></asset>
<worldbody><body name="base" pos="0 0 1"><joint name="turn" axis="0 0 1" range="-100 100"/><geom type="box" size="0.1 0.1 0.02" mass="1"/><frame pos="0.1 0 0" euler="0 90 0"><attach model="part" prefix="left_"/></frame></body></worldbody>
<keyframe><key name="on" qpos=".1 .2 .3 .4" qvel=".5 .6 .7 .8" ctrl=".1 .2 .3"/></keyframe></mujoco>"#;
    agrees(
        "mjcf-attach-2",
        [model, part],
        &[
            ("turn", -0.005271281092384254),
            ("left_hinge", -213.6476988689817),
            ("left_h2", -1866.4636219498095),
            ("left_oj", -279.31692512627563),
        ],
    );
    let model = r#"<mujoco model="whole"><default><geom density="2000"/><joint damping="7"/></default><asset><model name="part" file="part.xml"/></asset>
<worldbody><body name="base" pos="0 0 1"><joint name="turn" axis="0 0 1" range="-100 100"/><geom type="box" size="0.1 0.1 0.02" mass="1"/><frame pos="0.1 0 0" euler="0 90 0"><attach model="part" body="link" prefix="l_"/><attach model="part" body="tip" prefix="r_"/></frame></body></worldbody><actuator><motor name="pm" joint="turn"/></actuator>
<keyframe><key name="on" qpos=".1 .2 .3 .4" qvel=".5 .6 .7 .8" ctrl=".1 .2 .3"/></keyframe></mujoco>"#;
    agrees(
        "mjcf-attach-3",
        [model, part],
        &[
            ("turn", -690.0862958696798),
            ("l_hinge", -145.14325182705588),
            ("l_h2", -2414.6497317203716),
            ("r_h2", -897.8383078403556),
        ],
    );
}
