//! MJCF: loops that are open in the drawn configuration. Values are from MuJoCo's matrices at rest, with its equalities as exact rows.

use super::agrees;

#[test]
fn two_sites_meet_at_the_keyframe() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody>
<body name="A"><joint name="a1" axis="0 1 0" stiffness="3"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="A2" pos="1 0 0"><joint name="a2" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 .8 0 0"/><site name="ta" pos=".8 0 0" euler="0.1 0.2 0.3"/></body></body>
<body name="B" pos="1.5 0 0" euler="0 0.5 0"><joint name="b1" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/><site name="tb" pos="1 0 0"/></body></worldbody>
<equality><connect site1="ta" site2="tb"/></equality>
<keyframe><key name="on" qpos="-0.8456009448775357 0.5294737741494226 -2.147231812223328"/></keyframe></mujoco>"#,
        &[("a1", 8.607445497795634), ("a2", -16.565423578229485), ("b1", 4.475387928302537)],
    );
}

#[test]
fn a_weld_holds_the_pose_that_is_written() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody>
<body name="A"><joint name="a1" axis="0 1 0" stiffness="3"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="A2" pos="1 0 0"><joint name="a2" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 .8 0 0"/><site name="ta" pos=".8 0 0" euler="0.1 0.2 0.3"/></body></body>
<body name="B" pos="1.5 0 0" euler="0 0.5 0"><joint name="b1" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="B2" pos="1 0 0"><joint name="b2" axis="0 1 0"/><geom size=".05"/><site name="tc" pos="0.1 0 0.2" /></body><site name="tb" pos="1 0 0"/></body></worldbody>
<equality><weld body1="A2" body2="B2" relpose="0.8 0 0 0.9 0 0.43588989435406736 0"/></equality>
<keyframe><key name="on" qpos="-0.4604435313826948 -0.3066842189728554 -2.0990188249566875 1.733944698193663"/></keyframe></mujoco>"#,
        &[
            ("a1", 12.411022052008342),
            ("a2", -31.468075400425207),
            ("b1", -5.068785419876478),
            ("b2", -13.988267928542777),
        ],
    );
}

#[test]
fn the_anchor_of_a_weld_is_where_the_first_body_holds_it() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody>
<body name="A"><joint name="a1" axis="0 1 0" stiffness="3"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="A2" pos="1 0 0"><joint name="a2" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 .8 0 0"/><site name="ta" pos=".8 0 0" euler="0.1 0.2 0.3"/></body></body>
<body name="B" pos="1.5 0 0" euler="0 0.5 0"><joint name="b1" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="B2" pos="1 0 0"><joint name="b2" axis="0 1 0"/><geom size=".05"/><site name="tc" pos="0.1 0 0.2" euler="0 1 0"/></body><site name="tb" pos="1 0 0"/></body></worldbody>
<equality><weld body1="A2" body2="B2" anchor="0.1 0 0.2" relpose="0.8 0 0 0.9 0 0.43588989435406736 0"/></equality>
<keyframe><key name="on" qpos="-0.5183024643055981 -0.4827467983043013 -2.3541185104135667 1.7551228713961953"/></keyframe></mujoco>"#,
        &[
            ("a1", 11.197306021250254),
            ("a2", -34.48163010979078),
            ("b1", -5.492588020768354),
            ("b2", -17.791736067777617),
        ],
    );
}

#[test]
fn two_sites_are_welded_as_they_stand() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody>
<body name="A"><joint name="a1" axis="0 1 0" stiffness="3"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="A2" pos="1 0 0"><joint name="a2" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 .8 0 0"/><site name="ta" pos=".8 0 0" euler="0 0.2 0"/></body></body>
<body name="B" pos="1.5 0 0" euler="0 0.5 0"><joint name="b1" axis="0 1 0"/><geom type="capsule" size=".02" fromto="0 0 0 1 0 0"/>
<body name="B2" pos="1 0 0"><joint name="b2" axis="0 1 0"/><geom size=".05"/><site name="tc" pos="0.1 0 0.2" euler="0 1 0"/></body><site name="tb" pos="1 0 0"/></body></worldbody>
<equality><weld site1="ta" site2="tc"/></equality>
<keyframe><key name="on" qpos="-0.9250074340259951 0.46233056059589883 -2.0928263432903402 0.3301494698602463"/></keyframe></mujoco>"#,
        &[
            ("a1", 6.755290213926873),
            ("a2", -11.507183328569868),
            ("b1", 4.440264387199492),
            ("b2", -9.192157501842525),
        ],
    );
}
