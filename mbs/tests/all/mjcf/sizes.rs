//! MJCF: frames with a scale.

use super::agrees;

#[test]
fn frames_with_a_scale_multiply_lengths_masses_and_moments() {
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></body></frame></worldbody><keyframe>
<key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" /></keyframe></mujoco>"#,
        &[
            ("h", 4.134121198605882),
            ("h3", 2.220500577809525),
            ("p", -4.161987303054416),
            ("q", -1.7115168032658201),
        ],
    );
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="0.5" massscale="3" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></body></frame></worldbody><keyframe>
<key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" /></keyframe></mujoco>"#,
        &[
            ("h", 16.573130305411006),
            ("h3", 10.098057682042342),
            ("p", -3.196831074231695),
            ("q", -3.04673866862751),
        ],
    );
    agrees(
        r#"<mujoco><worldbody><frame scale="2"><replicate count="2" offset="0.3 0 0" euler="0 0 30"><body name="b" pos="0.2 0 0">
<joint name="h" axis="0 1 0"/><geom size="0.1" pos="0.2 0 0"/></body></replicate></frame></worldbody><keyframe>
<key name="on" qpos="0.1 0.2"/></keyframe></mujoco>"#,
        &[("h0", 22.184070139494164), ("h1", 21.851029837778587)],
    );
}

#[test]
fn frames_in_frames_multiply_their_scales() {
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<frame pos="0.1 0.1 0" scale="0.7" scaling="geometry"><body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></frame></body></frame></worldbody><keyframe>
<key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" /></keyframe></mujoco>"#,
        &[
            ("h", 2.0717490110028822),
            ("h3", 1.5444619648678732),
            ("p", -4.4762106852549834),
            ("q", -6.331142670610571),
        ],
    );
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" scaling="geometry" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<frame pos="0.1 0.1 0" scale="0.7" massscale="2"><body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></frame></body></frame></worldbody><keyframe>
<key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" /></keyframe></mujoco>"#,
        &[
            ("h", 5.85973296468447),
            ("h3", 2.6097944836358264),
            ("p", -3.27972936103662),
            ("q", -0.9493090543987321),
        ],
    );
}

#[test]
fn a_scale_of_the_geometry_alone_leaves_forces() {
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" scaling="geometry" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></body></frame></worldbody><keyframe>
<key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" /></keyframe></mujoco>"#,
        &[
            ("h", 4.7536128016581305),
            ("h3", 2.7159995219267987),
            ("p", -3.357548608490135),
            ("q", -0.8305764596470961),
        ],
    );
}

#[test]
fn actuators_in_frames_with_a_scale_grow_with_them() {
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></body></frame></worldbody><actuator>
<motor joint="h" gear="2" forcerange="-1 2" ctrlrange="-3 4" armature=".1" damping=".2 .1"/>
<position joint="p" kp="3" kv="1" gear="2" forcerange="-10 2" ctrlrange="-3 4" damping=".2 .1 .3" armature=".1"/><motor joint="p"/>
<velocity joint="p" kv="2" ctrlrange="0 .1"/><general joint="p" gaintype="affine" gainprm="1 2 3" biastype="affine" biasprm="1 2 3"/>
<intvelocity joint="p" kp="2" actrange="0 0.1"/><position joint="q" kp="3" dampratio="1"/><damper joint="p" kv="2" ctrlrange="0 .1"/>
</actuator><keyframe><key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" ctrl=".3 .5 .6 .2 .3 .4 .5 .3" act="0.05"/></keyframe></mujoco>"#,
        &[
            ("h", 3.455783147924863),
            ("h3", 1.9228487343145702),
            ("p", -10.444753302182587),
            ("q", -11.43100782648478),
        ],
    );
    agrees(
        r#"<mujoco><compiler angle="radian" autolimits="true"/><worldbody><frame scale="2" scaling="geometry" pos="0.1 0.2 0.3" euler="0.2 0.3 0.4">
<body name="a" pos="0.3 0 0.5" gravcomp="0.5">
<joint name="h" axis="0 1 0" pos="0.1 0.2 0.3" stiffness="2 3 4" damping="0.1 .2 .3" armature="0.01" ref="0.3" springref="0.4" actuatorfrcrange="-1 2"/>
<geom type="box" pos="0.2 0 0" size="0.2 0.03 0.03" density="800" euler="0.1 0.2 0.3"/><frame scale="1.5" pos="0.1 0 0" euler="1 0 0">
<geom type="capsule" size="0.05 0.1" pos="0 .3 0"/><joint name="h3" axis="0 0 1" pos="0.2 0 0" damping="0.3"/></frame>
<body name="b" pos="0.3 0 0.5">
<joint name="p" type="slide" axis="0 1 0" stiffness="20 30 40" damping="0.1 .2 .3" armature="0.1" ref="0.03" springref="0.04"/>
<geom type="capsule" size="0.1 0.2" mass="3"/><body name="c" pos="0.3 0 0.5"><joint name="q" axis="1 0 0" stiffness="2 3 4"/>
<inertial pos="0.1 0 0" mass="2" diaginertia="1 2 2.5"/></body></body></body></frame></worldbody><actuator>
<motor joint="h" gear="2" forcerange="-1 2" ctrlrange="-3 4" armature=".1" damping=".2 .1"/>
<position joint="p" kp="3" kv="1" gear="2" forcerange="-10 2" ctrlrange="-3 4" damping=".2 .1 .3" armature=".1"/><motor joint="p"/>
<velocity joint="p" kv="2" ctrlrange="0 .1"/><general joint="p" gaintype="affine" gainprm="1 2 3" biastype="affine" biasprm="1 2 3"/>
<intvelocity joint="p" kp="2" actrange="0 0.1"/><position joint="q" kp="3" dampratio="1"/><damper joint="p" kv="2" ctrlrange="0 .1"/>
</actuator><keyframe><key name="on" qpos="0.4 0.2 0.05 0.3" qvel="1 .5 2 3" ctrl=".3 .5 .6 .2 .3 .4 .5 .3" act="0.05"/></keyframe></mujoco>"#,
        &[
            ("h", 4.750460630179922),
            ("h3", 2.7401586797795385),
            ("p", -5.504953920636737),
            ("q", -2.6486054079275236),
        ],
    );
}
