//! MJCF: actuators, their limits and their states.

use super::agrees;

#[test]
fn the_limit_of_a_joint_is_of_the_sum_of_its_actuators() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" actuatorfrcrange="-2 3"/><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/>
<joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<motor joint="j" gear="4"/><motor joint="j" gear="2"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl=".6 .8"/></keyframe></mujoco>"#,
        &[("j", 10.266422192922715), ("k", 35.25980007920809), ("l", -3.4111724014020552)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" actuatorfrcrange="-2 3"/><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/>
<joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<motor joint="j" gear="4"/><motor joint="j" gear="-20"/><motor tendon="t" gear="0.5"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl=".6 .8 1"/></keyframe></mujoco>"#,
        &[("j", -6.610507450073306), ("k", 28.932730077280404), ("l", -8.823524243941822)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" actuatorfrcrange="0.1 3"/><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" actuatorfrcrange="-2 3" ref="0.4"/>
<geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" >
<joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/>
</spatial></tendon><actuator><position joint="l" kp="30" gear="2"/><motor tendon="t" gear="0.5"/><motor joint="j"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl=".6 .8 1"/></keyframe></mujoco>"#,
        &[("j", 7.756620577877669), ("k", 32.15102968274746), ("l", 3.4095097781208676)],
    );
}

#[test]
fn the_limit_of_a_tendon_is_of_its_actuators_before_their_gears() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" actuatorfrcrange="-1.5 1.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><motor tendon="t" gear="4"/></actuator>
<keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="3"/></keyframe></mujoco>"#,
        &[("j", 34.95390146647264), ("k", 6.390928344570197), ("l", -49.3894142324029)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" actuatorfrcrange="-1.5 1.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" actuatorfrcrange="-1.5 0.2"><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<motor tendon="t" gear="4"/><motor tendon="t" gear="4"/><motor tendon="u" gear="2" forcerange="-1 1"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="3 -1 5"/></keyframe></mujoco>"#,
        &[("j", 34.909314657555846), ("k", 7.229894330434614), ("l", -48.45782079438248)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" actuatorfrcrange="-3 3"/><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" actuatorfrcrange="-1.5 1.5">
<joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/>
</spatial></tendon><actuator><motor tendon="t" gear="4"/><motor joint="j" gear="2"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="3 1"/></keyframe></mujoco>"#,
        &[("j", 5.317731685233224), ("k", 0.25319335041874347), ("l", -51.863759486247645)],
    );
}

#[test]
fn actuators_of_a_limited_tendon_lose_one_factor() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" actuatorfrcrange="-1.5 1.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><motor tendon="t" gear="4"/>
<motor tendon="t" gear="-2"/></actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="3 1"/></keyframe></mujoco>"#,
        &[("j", 21.99157551623649), ("k", 16.449538370790478), ("l", -32.45686670250818)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" actuatorfrcrange="-1.5 1.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><motor tendon="t" gear="4"/>
<motor tendon="t" gear="-2"/></actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="1 0.2"/></keyframe></mujoco>"#,
        &[("j", 21.12742045288741), ("k", 17.120112372538493), ("l", -31.3280302005152)],
    );
}

#[test]
fn drag_of_an_actuator_is_in_the_rate_of_what_it_pulls() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" >
<site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<motor joint="j" gear="2" damping="0.5 0.25 0.125" armature="0.1"/><motor tendon="t" gear="2" damping="0.5 .2 .1" armature="0.2"/>
<motor tendon="u" gear="-3" damping="0 .2" armature="0.3"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="0 0 0"/></keyframe></mujoco>"#,
        &[("j", -2.508459508993954), ("k", 34.59561454433825), ("l", -1.7207773518019487)],
    );
}

#[test]
fn gains_follow_lengths_and_rates() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" >
<site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><damper joint="j" kv="2" ctrlrange="0 3" gear="2"/>
<damper tendon="u" kv="3" ctrlrange="0 3"/></actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="2 1.5"/>
</keyframe></mujoco>"#,
        &[("j", -25.86222802141616), ("k", 26.00188812557402), ("l", -8.38550818156138)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" ref="0.3"/><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/>
</body></body></body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<general joint="l" gear="2" gaintype="affine" gainprm="3 4 5" biastype="affine" biasprm="1 2 3"/>
<general tendon="u" gear="2" gaintype="affine" gainprm="3 4 5"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="2 1.5"/></keyframe></mujoco>"#,
        &[("j", 0.6462854232891232), ("k", 294.9470157151962), ("l", 119.42702244100688)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><damper kv="4"/></default><worldbody><site name="w" pos="0.5 0.4 1.2"/>
<body name="b" pos="0 0 1"><joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/>
<joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<damper joint="j" ctrlrange="0 2"/><damper joint="k" kv="1" ctrlrange="0 2"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="1 1"/></keyframe></mujoco>"#,
        &[("j", -5.720737185998513), ("k", 46.72375930876186), ("l", -3.4244406140851043)],
    );
}

#[test]
fn activations_start_as_the_keyframe_says() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" >
<site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><intvelocity joint="j" kp="3" kv="0.5" actrange="-1 2"/>
<cylinder joint="l" timeconst="0.3" area="2" bias="1 2 3"/><position joint="k" kp="7" timeconst="0.2"/><motor joint="k"/></actuator>
<keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="2 1.5 .2 .3" act="0.7 0.5 0.4"/></keyframe></mujoco>"#,
        &[("j", 8.391862048575103), ("k", 165.2556629364941), ("l", 15.84422671649323)],
    );
}

#[test]
fn ranges_are_inherited_by_the_servo_that_asks_for_them() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><position kp="100" inheritrange="1"/><motor ctrlrange="-20 20"/>
<intvelocity inheritrange="0.5"/></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" range="0.2 1.6"/><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" range="-0.5 0.1"/><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/>
<site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" range="-1 2"/>
<geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" >
<joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/>
</spatial></tendon><actuator><position joint="j" gear="1"/><motor joint="k"/><velocity joint="k"/><intvelocity joint="l" kp="3"/>
</actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="9 9 9 9" act="0.2"/></keyframe></mujoco>"#,
        &[("j", 41.87132393957275), ("k", 437.0737392252789), ("l", 35.33143081235599)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><position inheritrange="0.5"/></default><worldbody><site name="w" pos="0.5 0.4 1.2"/>
<body name="b" pos="0 0 1"><joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0">
<joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/>
<body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><tendon><fixed name="t" range="-2 3"><joint joint="j" coef="2"/>
<joint joint="l" coef="-3"/></fixed><spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator>
<position tendon="t" kp="3"/></actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="9"/></keyframe></mujoco>"#,
        &[("j", 25.4481957696328), ("k", 13.767242363798399), ("l", -36.97221271048011)],
    );
}

#[test]
fn parameters_that_an_actuator_does_not_write_stay_those_of_its_class() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><general gainprm="5" biasprm="1 2 3" biastype="affine"/><default class="x">
<general gainprm="2" gear="3"/></default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" ><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed><spatial name="u" >
<site site="w"/><site site="s"/><site site="r"/></spatial></tendon><actuator><general joint="j" gainprm="7"/>
<general joint="k" biasprm="0.5" class="x"/></actuator><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="1 1"/>
</keyframe></mujoco>"#,
        &[("j", 20.961414921320806), ("k", -355.11664223229224), ("l", -37.63268254311798)],
    );
}

#[test]
fn a_crank_moves_a_slider_by_a_rod() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody><body name="c" pos="0 0 1"><joint name="j" axis="0 1 0"/>
<geom type="box" size=".1 .02 .02" mass="2" pos=".1 0 0"/><site name="cs" pos="0.2 0.01 0"/></body>
<site name="ss" pos="-0.1 0.02 1.05" euler="0 1.5 0.1"/></worldbody><actuator>
<motor cranksite="cs" slidersite="ss" cranklength="0.25" gear="3"/></actuator><keyframe><key name="on" qpos="0.4" qvel="0.5" ctrl="2"/>
</keyframe></mujoco>"#,
        &[("j", 75.98839270340012)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody><body name="c" pos="0 0 1"><joint name="j" axis="0 1 0"/>
<geom type="box" size=".1 .02 .02" mass="2" pos=".1 0 0"/><site name="cs" pos="0.2 0.01 0"/></body>
<site name="ss" pos="-0.1 0.02 1.05" euler="0 1.5 0.1"/></worldbody><actuator>
<position cranksite="cs" slidersite="ss" cranklength="0.25" kp="30" kv="2" gear="2"/></actuator><keyframe>
<key name="on" qpos="0.4" qvel="0.5" ctrl="0.2"/></keyframe></mujoco>"#,
        &[("j", 71.66593761103007)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><worldbody><body name="c" pos="0 0 1"><joint name="j" axis="0 1 0"/>
<geom type="box" size=".1 .02 .02" mass="2" pos=".1 0 0"/><site name="cs" pos="0.2 0.01 0"/></body><body name="m" pos="0 0 1.2">
<joint name="k" axis="0 1 0.2"/><geom size="0.1" pos="0.1 0.1 0"/><site name="ss" pos="0.1 0 0" euler="0 1.5 0.1"/></body></worldbody>
<actuator><general cranksite="cs" slidersite="ss" cranklength="0.35" gear="2"  biastype="affine" biasprm="1 2 -3"/></actuator><keyframe>
<key name="on" qpos="0.4 0.1" qvel="0.5 -.3" ctrl="0.2"/></keyframe></mujoco>"#,
        &[("j", 70.42974365844152), ("k", 65.7267455166355)],
    );
}

#[test]
fn another_word_begins_from_the_nearest_outer_class_that_ends_with_it_or_with_general() {
    // hinges of 0.1 kg m^2 at rest: the acceleration is ten times the control, with the gain of MuJoCo 4.0.0
    for (classes, actuator, gain) in [
        (r#"<position kp="10"/><default class="c"><motor gear="1"/></default>"#, "position", 10.0),
        (r#"<position kp="10"/><default class="c"><motor gear="1"/></default>"#, "motor", 1.0),
        (r#"<position kp="10"/><default class="c"><motor gear="1"/></default>"#, "velocity", 1.0),
        (r#"<position kp="10"/><motor gear="1"/><default class="c"/>"#, "position", 1.0),
        (r#"<default class="c"><position kp="10"/><motor gear="1"/></default>"#, "position", 1.0),
        (
            r#"<default class="o"><position kp="10"/><default class="c"><velocity kv="3"/></default></default>"#,
            "position",
            10.0,
        ),
        (r#"<velocity kv="3"/><default class="c"><position kp="10"/></default>"#, "velocity", 3.0),
        (
            r#"<position kp="10"/><default class="c"><general gainprm="5"/></default>"#,
            "velocity",
            5.0,
        ),
        (
            r#"<position kp="10"/><default class="c"><motor gear="1"/><general gainprm="4"/></default>"#,
            "position",
            4.0,
        ),
        (
            r#"<general gainprm="7"/><default class="c"><motor gear="1"/></default>"#,
            "position",
            7.0,
        ),
        (r#"<position kp="10"/><default class="c"><muscle gear="1"/></default>"#, "position", 10.0),
    ] {
        let model = format!(
            r#"<mujoco><default>{classes}</default><worldbody><body><joint name="a" axis="0 1 0"/><inertial pos="0 0 -.3" mass="1" diaginertia=".01 .01 .01"/></body></worldbody>
<actuator><{actuator} class="c" joint="a"/></actuator><keyframe><key name="on" ctrl="0.2"/></keyframe></mujoco>"#
        );
        agrees(&model, &[("a", gain * 2.0)]);
    }
}

#[test]
fn ranges_of_a_muscle_in_a_class_hold_for_every_actuator_of_it() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><muscle ctrllimited="true" ctrlrange="0.5 1"/></default><worldbody>
<body><joint name="a" axis="0 1 0"/><inertial pos="0 0 -.3" mass="1" diaginertia=".01 .01 .01"/></body>
<body><joint name="b" axis="0 1 0"/><inertial pos="0 0 -.3" mass="1" diaginertia=".01 .01 .01"/></body></worldbody>
<actuator><position joint="a" kp="3"/><motor joint="b"/></actuator><keyframe><key name="on" qpos="0.1 0.1"/></keyframe></mujoco>"#,
        &[("a", 9.061902548083847), ("b", 2.061902548083847)],
    );
}
