//! MJCF: springs, dampers and inertia of joints and tendons.

use super::agrees;

#[test]
fn springs_and_dampers_of_three_numbers_have_an_even_and_an_odd_middle_term() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" stiffness="10 4 3" damping="1 .3 .2" springref="0.7"/><geom type="box" size=".1 .2 .3" mass="2"/>
<body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" stiffness="-5 2" damping="0 0 .4"/>
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" stiffness="3 -20 7" damping="2 3" ref="0.05"/><geom size="0.05" mass="0.4" pos="0 .1 0"/>
<site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" />
</keyframe></mujoco>"#,
        &[("j", 8.584210782029915), ("k", -20.649466288611805), ("l", -10.99341310826059)],
    );
}

#[test]
fn numbers_that_an_element_does_not_write_stay_those_of_its_class() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default><joint stiffness="10 40 7" damping="1 2 3"/></default><worldbody>
<site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1"><joint name="j" axis="0 0 1" stiffness="5"/>
<geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" damping="0.3 0.1"/>
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -22.550123613919588), ("k", 10.732974533236353), ("l", -12.656907030135585)],
    );
}

#[test]
fn a_time_and_a_damping_ratio_replace_the_first_numbers() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" springdamper="0.2 1" stiffness="3 4" damping="1 2"/><geom type="box" size=".1 .2 .3" mass="2"/>
<body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" /><geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/>
<site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0"><joint name="l" type="slide" axis="1 0 0.5" springdamper="0.1 0.5"/>
<geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body></body></worldbody><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -19.236527517259923), ("k", -1.7607103651667635), ("l", -49.57188907763951)],
    );
}

#[test]
fn tendons_have_springs_of_three_numbers_slack_between_two_lengths() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" stiffness="5 2 3" damping="1 2 3"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/>
</fixed><spatial name="u" stiffness="9 -4 2" damping="1 0 2" springlength="0.2"><site site="w"/><site site="s"/><site site="r"/></spatial>
</tendon><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -10.01074335162802), ("k", 33.06831022550799), ("l", 0.42828155970832027)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" stiffness="5 2 3" springlength="-0.1 0.1"><joint joint="j" coef="2"/>
<joint joint="l" coef="-3"/></fixed><spatial name="u" stiffness="9 -4 2" springlength="0.9 1.2"><site site="w"/><site site="s"/>
<site site="r"/></spatial></tendon><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -6.167622949865706), ("k", 41.82116901237212), ("l", 8.149535884562018)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" stiffness="5 2 3" springlength="0.5 0.7"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/>
</fixed><spatial name="u" stiffness="9" springlength="0.2 0.3" damping="1 2"><site site="w"/><site site="s"/><site site="r"/></spatial>
</tendon><keyframe><key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", 6.276921059939985), ("k", 20.51116389618794), ("l", -20.75921073298441)],
    );
}

#[test]
fn strands_behind_a_pulley_count_by_its_divisor() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><spatial name="u" stiffness="20 3" damping="1" armature="0.2" springlength="0.3"><site site="w"/>
<site site="s"/><pulley divisor="2"/><site site="s"/><site site="r"/><site site="w"/></spatial></tendon><actuator>
<motor tendon="u" gear="2"/><position tendon="u" kp="3" kv="0.2"/></actuator><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" ctrl="1 .4"/></keyframe></mujoco>"#,
        &[("j", 6.099615201188225), ("k", 34.636646175214636), ("l", -11.450817783250464)],
    );
}

#[test]
fn armature_of_tendons_moves_with_their_length() {
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" armature="0.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" armature="0.7"><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -1.830312697440571), ("k", 34.80691748577816), ("l", -1.477698539782373)],
    );
    agrees(
        r#"<mujoco><compiler angle="radian"/><default></default><worldbody><site name="w" pos="0.5 0.4 1.2"/><body name="b" pos="0 0 1">
<joint name="j" axis="0 0 1" /><geom type="box" size=".1 .2 .3" mass="2"/><body name="c" pos="0.3 0 0"><joint name="k" axis="0 1 0" />
<geom type="box" size=".1 .05 .07" pos=".1 .02 .03" mass="1"/><site name="s" pos="0.1 0.1 0"/><body name="d" pos="0.2 0 0">
<joint name="l" type="slide" axis="1 0 0.5" /><geom size="0.05" mass="0.4" pos="0 .1 0"/><site name="r" pos="0.1 -0.1 0.2"/></body></body>
</body></worldbody><tendon><fixed name="t" armature="0.5"><joint joint="j" coef="2"/><joint joint="l" coef="-3"/></fixed>
<spatial name="u" ><site site="w"/><site site="s"/><site site="r"/></spatial></tendon><keyframe>
<key name="on" qpos="0.3 -0.4 0.1" qvel="0.5 -0.7 0.3" /></keyframe></mujoco>"#,
        &[("j", -1.7641045381582172), ("k", 34.88366219179056), ("l", -1.4250763301419866)],
    );
}
