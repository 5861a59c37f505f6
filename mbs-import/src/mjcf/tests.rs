//! Models of about ten lines: masses, positions and axes are compared with those of MuJoCo 4.0.0.

use crate::context::Context;
use crate::findings::Findings;
use crate::options::ImportOptions;
use crate::pose::{V3, v3};
use crate::robot::{Kind, Robot, Signal, Target, What};
use crate::source::Sources;
use mbs_core::algebra::cross;

/// Rounding errors of rotated tensors of size one [-].
const TOLERANCE: f64 = 1.0e-12;

fn robot(text: &str) -> Robot {
    let options = ImportOptions::default();
    let mut context =
        Context { sources: Sources::default(), findings: Findings::default(), options: &options };
    let source = context.sources.add("model.xml", text, None);
    let root = crate::xml::read(text, source).expect("XML");
    super::read(&root, &mut context).expect("read")
}

/// Compares each body with a line of expected numbers, in global axes. A line has mass, centre and tensor xx yy zz xy yz zx, then origin, x
/// axis and y axis of the body's frame.
fn agrees(text: &str, bodies: &str) {
    let robot = robot(text);
    for line in bodies.lines() {
        let (name, numbers) = line.split_once(' ').expect("name");
        let link = robot.links.iter().find(|link| link.name == name).expect("body");
        let found = link.mass.expect("mass");
        let found =
            core::iter::once(found.mass).chain(found.center.iter().copied()).chain(found.six());
        let turn = &link.pose.turn;
        let pose = link
            .pose
            .at
            .iter()
            .chain(turn.column(0).iter())
            .chain(turn.column(1).iter())
            .copied()
            .collect::<Vec<_>>();
        let wanted: Vec<f64> = numbers.split(' ').map(|x| x.parse().expect("number")).collect();
        assert_eq!(wanted.len(), 19);
        for (found, wanted) in found.chain(pose).zip(wanted) {
            assert!(
                (found - wanted).abs() <= TOLERANCE * wanted.abs().max(1.0),
                "{name}: {found} for {wanted}"
            );
        }
    }
}

#[test]
fn masses_of_all_forms_are_those_of_the_other_program() {
    agrees(
        r#"<mujoco><worldbody>
<body name="a" pos="1 2 3"><freejoint/><geom size=".1"/></body>
<body name="b"><freejoint/><geom type="box" size=".1 .2 .3" density="500" euler="10 20 30" pos=".1 .2 .3"/></body>
<body name="c" euler="0 90 0"><freejoint/><geom type="ellipsoid" size=".1 .2 .3" mass="2"/></body>
<body name="d"><freejoint/><geom type="cylinder" size=".1 .2"/><geom type="capsule" size=".1 .2" pos="1 0 0" zaxis="1 2 -3"/></body>
<body name="e"><freejoint/><geom type="capsule" size=".1" fromto="1 0 0 1.3 0.4 0.5"/><geom type="box" fromto="0 0 0 0 0 1" size=".1"/></body>
</worldbody></mujoco>"#,
        "a 4.188790204786391 1.0 2.0 3.0 0.01675516081914557 0.01675516081914557 0.01675516081914557 0.0 0.0 0.0 1.0 2.0 3.0 1.0 0.0 0.0 0.0 1.0 0.0
b 24.000000000000004 0.1 0.2 0.3 0.9121528885045038 0.8603318308584589 0.4675152806370376 0.12854159206134197 0.03366186961235753 -0.1666187061295448 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
c 2.0 0.0 0.0 0.0 0.020000000000000004 0.04 0.052000000000000005 0.0 0.0 0.0 0.0 0.0 0.0 2.220446049250313e-16 0.0 -1.0 0.0 1.0 0.0
d 29.321531433504745 0.5714285714285714 0.0 0.0 0.6188937527571929 7.721137144622727 7.454101769067598 -0.052359877559831125 0.1570796326794896 0.07853981633974481 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
e 66.40320489557823 0.4572623516841258 0.0795238872494132 0.40059514093823356 6.458616637594896 26.645830757647655 22.81712088862579 -4.019235315339019 0.19334470271748963 4.1212028895088 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0",
    );
}

#[test]
fn orientations_in_all_words_are_those_of_the_other_program() {
    agrees(
        r#"<mujoco><compiler eulerseq="xYz"/><worldbody>
<body name="a" euler="10 20 30"><freejoint/><geom size=".1"/></body>
<body name="b" axisangle="1 2 3 40"><freejoint/><geom size=".1"/></body>
<body name="c" xyaxes="1 2 3 0 1 0"><freejoint/><geom size=".1"/></body>
<body name="d" zaxis="1 2 -3"><freejoint/><geom size=".1"/></body>
<body name="e" quat="1 2 3 4"><freejoint/><geom size=".1"/></body>
</worldbody></mujoco>"#,
        "a 4.188790204786391 0.0 0.0 0.0 0.016755160819145562 0.016755160819145562 0.016755160819145562 0.0 0.0 0.0 0.0 0.0 0.0 0.8434932686563159 0.49240387650610395 -0.21461017714275632 -0.4184120444167325 0.852868531952443 0.3123245560187263
b 4.188790204786391 0.0 0.0 0.0 0.016755160819145572 0.01675516081914557 0.01675516081914557 0.0 0.0 0.0 0.0 0.0 0.0 0.7827555543247654 0.5487988669638042 -0.29345109608412456 -0.4819544221406551 0.8328888879421272 0.2720588820854669
c 4.188790204786391 0.0 0.0 0.0 0.016755160819145565 0.016755160819145565 0.016755160819145565 0.0 0.0 0.0 0.0 0.0 0.0 0.2672612419124244 0.5345224838248488 0.801783725737273 -0.16903085094570336 0.8451542547285165 -0.50709255283711
d 4.188790204786391 0.0 0.0 0.0 0.016755160819145565 0.016755160819145565 0.01675516081914557 0.0 0.0 0.0 0.0 0.0 0.0 0.6396432548525453 -0.7207134902949092 -0.2672612419124244 -0.7207134902949092 -0.44142698058981844 -0.5345224838248488
e 4.188790204786391 0.0 0.0 0.0 0.016755160819145562 0.016755160819145562 0.016755160819145562 0.0 0.0 0.0 0.0 0.0 0.0 -0.6666666666666665 0.6666666666666665 0.33333333333333326 0.13333333333333336 -0.33333333333333326 0.9333333333333332",
    );
}

#[test]
fn angles_in_radians_of_fixed_axes_and_of_turning_ones() {
    agrees(
        r#"<mujoco><compiler angle="radian" eulerseq="ZYX"/><worldbody>
<body name="a" euler=".1 .2 .3"><joint/><geom size=".1"/><body name="b" pos="1 2 3" euler="1 0 -2"><joint/><geom size=".1"/></body></body>
</worldbody></mujoco>"#,
        "a 4.188790204786391 0.0 0.0 0.0 0.016755160819145565 0.016755160819145565 0.016755160819145562 0.0 0.0 0.0 0.0 0.0 0.0 0.9751703272018158 0.1537919979889642 -0.1593450793079779 -0.0978433950072557 0.9447024859948941 0.3129918257854679
b 4.188790204786391 1.3754915295724883 1.174308537102206 3.2755186630155553 0.016755160819145572 0.016755160819145572 0.01675516081914557 0.0 0.0 0.0 1.3754915295724883 1.174308537102206 3.2755186630155553 0.4091378128693698 -0.026108241137893062 -0.9120990131697075 -0.8961832756037429 -0.1995295665675979 -0.39628712897783164",
    );
}

#[test]
fn fullinertia_has_xy_xz_yz_in_turned_axes() {
    agrees(
        r#"<mujoco><worldbody>
<body name="a" euler="10 20 30"><joint/><inertial pos=".1 .2 .3" mass="2" fullinertia="1 2 2.5 .1 .2 .3"/></body>
<body name="b"><joint/><inertial pos=".1 .2 .3" mass="2" euler="10 20 30" diaginertia="1 2 2.5"/><geom size="1"/></body>
</worldbody></mujoco>"#,
        "a 2.0 0.09001654905404712 0.1700656298273723 0.3208967161686443 1.3346661938452833 1.6909981218606762 2.474335684294085 -0.3109362719926342 0.3566570659157759 0.399426569273167 0.0 0.0 0.0 0.8137976813493737 0.5438381424823255 -0.2048741287028621 -0.46984631039295416 0.8231729446455008 0.3187957775971678
b 2.0 0.1 0.2 0.3 1.3962222230506383 1.717553263773888 2.3862245131754727 -0.4704789436437043 0.03591551890206781 0.3249816462967343 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0",
    );
}

#[test]
fn classes_inherit_from_their_parents_and_childclass_holds_until_the_next() {
    agrees(
        r#"<mujoco><default><geom density="500" size=".3"/><default class="x"><geom size=".2"/><default class="y"><geom density="200"/></default></default></default>
<worldbody><body name="a" childclass="y"><joint/><geom/><body name="b"><joint/><geom class="main"/><geom class="x" pos="1 0 0"/></body>
<body name="c" childclass="x"><joint/><geom type="box" size="1 2 3"/><geom/></body></body></worldbody></mujoco>"#,
        "a 6.702064327658226 0.0 0.0 0.0 0.10723302924253161 0.10723302924253161 0.10723302924253161 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
b 73.30382858376184 0.2285714285714286 0.0 0.0 2.3038346126325275 15.229244387402034 15.229244387402034 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
c 24016.755160819146 0.0 0.0 0.0 104000.26808257311 80000.26808257311 40000.26808257311 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0",
    );
}

#[test]
fn settotalmass_scales_mass_and_inertia_bounds_come_before() {
    agrees(
        r#"<mujoco><compiler settotalmass="10" boundmass="1" boundinertia="0.05" inertiagrouprange="1 2"/><worldbody><geom size="1"/>
<body name="a"><joint/><geom size=".1" group="1"/><geom size="3"/></body><body name="b"><joint/><inertial pos="1 0 0" euler="10 20 30" mass="3" diaginertia=".3 .3 .01"/></body></worldbody></mujoco>"#,
        "a 5.826836067628514 0.0 0.0 0.0 0.06955273220619144 0.06955273220619144 0.06955273220619144 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
b 4.173163932371486 1.0 0.0 0.0 0.37663577274740834 0.40805670654908077 0.1194930393839994 0.019408498138990104 0.05251429276939456 -0.11007106264173877 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0",
    );
}

#[test]
fn balanceinertia_sets_the_mean_and_inertiafromgeom_takes_the_geoms() {
    agrees(
        r#"<mujoco><compiler balanceinertia="true" inertiafromgeom="true"/><worldbody>
<body name="a"><joint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 5"/></body>
<body name="b"><joint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 5"/><geom size=".2"/></body></worldbody></mujoco>"#,
        "a 1.0 0.0 0.0 0.0 2.3333333333333335 2.3333333333333335 2.3333333333333335 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0
b 33.51032163829113 0.0 0.0 0.0 0.5361651462126582 0.5361651462126582 0.5361651462126582 0.0 0.0 0.0 0.0 0.0 0.0 1.0 0.0 0.0 0.0 1.0 0.0",
    );
}

#[test]
fn replicate_turns_and_moves_copies_frame_turns_what_is_in_it() {
    agrees(
        r#"<mujoco><worldbody><replicate count="3" offset="1 0 0" euler="0 0 40" sep="_"><body name="b" pos=".1 .2 .3"><joint/><geom type="box" size=".1 .2 .3"/></body></replicate>
<frame pos="0 0 1" euler="90 0 0"><body name="c" pos="1 2 3"><joint/><frame euler="0 30 0"><geom type="box" size=".1 .2 .3" pos="0 0 1"/></frame></body></frame></worldbody></mujoco>"#,
        "b_0 48.00000000000001 0.1 0.2 0.3 2.0800000000000005 1.6000000000000003 0.8000000000000003 0.0 0.0 0.0 0.1 0.2 0.3 1.0 0.0 0.0 0.0 1.0 0.0
b_1 48.00000000000001 0.94804692237459 0.2174876495924496 0.3 1.881675562640064 1.7983244373599374 0.8000000000000003 0.23635386072293005 0.0 0.0 0.94804692237459 0.2174876495924496 0.3 0.7660444431189781 0.6427876096865394 0.0 -0.6427876096865394 0.7660444431189781 0.0
b_2 48.00000000000001 1.5864477102832295 0.7759980205211463 0.29999999999999993 1.614473771011382 2.065526228988618 0.8 0.08208483439816056 0.0 0.0 1.5864477102832295 0.7759980205211463 0.29999999999999993 0.17364817766693041 0.9848077530122079 0.0 -0.9848077530122079 0.17364817766693041 0.0
c 48.00000000000001 1.5 -3.8660254037844384 3.000000000000001 1.7600000000000007 1.1200000000000003 1.6000000000000003 0.554256258422041 -1.474601807633381e-17 -1.5557919839888445e-16 1.0 -2.9999999999999996 3.000000000000001 1.0 0.0 0.0 0.0 2.220446049250313e-16 1.0",
    );
}

/// The law with this name; the test fails when there is none.
fn law<'a>(robot: &'a Robot, name: &str) -> &'a What {
    &robot.laws.iter().find(|law| law.name == name).expect("law").what
}

#[test]
fn joints_of_a_body_are_a_chain_and_the_first_is_outermost() {
    let text = r#"<mujoco><worldbody><body name="a"><geom size=".1"/>
<joint name="i" axis="0 0 2"/><joint name="j" axis="1 0 0" pos="0 1 0"/></body>
<body name="b"><geom size=".1"/><joint name="x" type="slide" axis="1 0 0"/><joint name="z" type="slide"/><joint name="t" axis="0 1 0" ref="90"/></body>
</worldbody></mujoco>"#;
    let robot = robot(text);
    let kinds: Vec<_> =
        robot.joints.iter().map(|joint| (joint.name.as_str(), joint.kind)).collect();
    assert_eq!(kinds, [("i", Kind::Revolute), ("j", Kind::Revolute), ("x+z+t", Kind::Planar)]);
    assert_eq!(robot.links[robot.joints[0].child].name, "a~1");
    assert_eq!(robot.joints[0].child, robot.joints[1].parent);
    assert_eq!(robot.joints[1].place.as_slice(), [0.0, 1.0, 0.0]);
}

#[test]
fn springs_of_joints_and_tendons_pull_as_qfrc_passive_says() {
    // MuJoCo's qfrc_passive at qpos0 is −2 − 11.2 and 16.8.
    let text = r#"<mujoco><compiler angle="radian"/><worldbody>
<body><geom size=".1"/><joint name="a" ref="0.5" springref="0.1" stiffness="5" damping="0.7" armature="0.2"/></body>
<body><geom size=".1"/><joint name="b" range="-1 2" solreflimit="-300 -4"/></body></worldbody>
<tendon><fixed name="t" stiffness="7"><joint joint="a" coef="-2"/><joint joint="b" coef="3"/></fixed></tendon></mujoco>"#;
    let robot = robot(text);
    let What::Spring { stiffness, damping, free, .. } = law(&robot, "a spring") else {
        panic!("no spring")
    };
    assert!((stiffness * free - -2.0).abs() < TOLERANCE && *damping == 0.7);
    let What::Spring { on: Target::Sum(terms), stiffness, free, .. } = law(&robot, "t spring")
    else {
        panic!("no spring")
    };
    let pull: Vec<_> = terms.iter().map(|term| stiffness * free * term.factor).collect();
    assert!((pull[0] - -11.2).abs() < TOLERANCE && (pull[1] - 16.8).abs() < TOLERANCE, "{pull:?}");
    // I = 2/5 m r² of a sphere of 1000 kg/m³, with the joint through its centre.
    let inertia = 0.4 * 1000.0 * 4.0 / 3.0 * core::f64::consts::PI * 1.0e-5;
    let What::RangeLimit { stiffness: Some([k, d]), .. } = law(&robot, "b stops") else {
        panic!("no stops")
    };
    assert!(
        (k - 300.0 * inertia).abs() < TOLERANCE && (d - 4.0 * inertia).abs() < TOLERANCE,
        "{k} {d}"
    );
}

#[test]
fn ends_of_tendons_are_stops_of_the_mass_that_tendon_invweight0_says() {
    // MuJoCo's value of 1 / tendon_invweight0.
    let text = r#"<mujoco><worldbody><site name="w" pos="0 .1 1"/>
<body name="a" pos="0 0 1"><joint name="i" axis="0 1 0"/><geom size=".1" pos=".3 0 0"/><body pos=".5 0 0"><joint name="j"/><geom size=".1" pos=".2 .1 0"/><site name="s" pos=".3 0 .1"/></body></body></worldbody>
<tendon><fixed name="t" range="-1 2" solreflimit=".1 .5"><joint joint="i" coef="-2"/><joint joint="j" coef="3"/></fixed>
<spatial name="u" limited="true" range="0 .9" solreflimit=".1 .5"><site site="w"/><site site="s"/></spatial></tendon></mujoco>"#;
    let robot = robot(text);
    for (name, invweight) in [("t", 41.41276580452379), ("u", 0.00602859632923846)] {
        let What::Limit { stiffness, damping, .. } = law(&robot, &format!("{name} stops")) else {
            panic!("no stops")
        };
        let [stiffness, damping] = [stiffness * 0.05 * 0.05, damping * 0.05].map(|x| x * invweight);
        assert!((stiffness - 1.0).abs() < TOLERANCE, "{name}: {stiffness}");
        assert!((damping - 1.0).abs() < TOLERANCE, "{name}: {damping}");
    }
    let What::Limit { upper, .. } = law(&robot, "u stops") else { panic!("no stops") };
    // The line has a length of 0.812… m as drawn.
    assert!((upper - (0.9 - (0.8_f64 * 0.8 + 0.1 * 0.1 + 0.1 * 0.1).sqrt())).abs() < TOLERANCE);
}

#[test]
fn equalities_are_couplings_of_deviations_and_joints_of_loops() {
    let text = r#"<mujoco><worldbody><body name="p" pos="1 0 0" euler="0 0 90"><geom size=".1"/><joint name="a" ref="20"/>
<body name="q"><geom size=".1"/><joint name="b" ref="10"/></body></body></worldbody>
<equality><joint joint1="b" joint2="a" polycoef="0.1 2 0 0 0"/><joint joint1="b" joint2="a" polycoef="0.1 2 3 4 5"/><connect body1="q" anchor="1 0 0"/></equality></mujoco>"#;
    let robot = robot(text);
    let linear = &robot.couplings[0];
    assert_eq!((linear.value, linear.terms[1].factor), (0.1, -2.0));
    let curved = &robot.couplings[1].terms[1];
    assert_eq!((curved.factor, &curved.coefficients[..]), (-1.0, &[0.0, 2.0, 3.0, 4.0, 5.0][..]));
    let ball = robot.joints.last().expect("joint");
    assert_eq!(ball.kind, Kind::Spherical);
    // The file rotates the anchor by 90 degrees.
    assert!((ball.place[0] - 1.0).abs() < TOLERANCE && (ball.place[1] - 1.0).abs() < TOLERANCE);
}

#[test]
fn a_position_actuator_has_the_force_of_qfrc_actuator_as_drawn() {
    let text = r#"<mujoco><compiler angle="radian"/><default><position kp="20" kv="3"/></default><worldbody>
<body><geom size=".1"/><joint name="a" ref="0.5"/></body></worldbody>
<actuator><position name="p" joint="a" gear="2" ctrlrange="-1 1"/><motor name="m" joint="a" gear="3" forcerange="-1 1"/></actuator></mujoco>"#;
    let robot = robot(text);
    let What::Signal(Signal::Sum { of }) = law(&robot, "p force") else { panic!("no sum") };
    let What::Signal(Signal::Constant { value }) = law(&robot, "p constant") else {
        panic!("no constant")
    };
    let factor = |name: &str| {
        of.iter().find(|(signal, _)| signal == name).map_or(0.0, |(_, factor)| *factor)
    };
    let force = 0.7 * factor("p control") + value * factor("p constant");
    assert!((force - -12.0).abs() < TOLERANCE, "{force}");
    assert_eq!((factor("p value"), factor("p rate")), (-80.0, -12.0));
    let What::Signal(Signal::Sum { of }) = law(&robot, "m geared") else { panic!("no gear") };
    assert_eq!(of[..], [("m limited".to_owned(), 3.0)]);
}

#[test]
fn a_motor_at_a_site_pushes_and_turns_as_qfrc_actuator_says() {
    let text = r#"<mujoco><worldbody><body name="b"><freejoint name="f"/><geom size=".1"/><site name="s" pos=".1 .2 .3" euler="20 30 40"/></body></worldbody>
<actuator><motor name="jet" site="s" gear="1 2 3 4 5 6"/></actuator></mujoco>"#;
    let robot = robot(text);
    let (mut force, mut moment) = (V3::zeros(), V3::zeros());
    for found in &robot.laws {
        let What::Push { at: Some(at), turns: true, signals, .. } = &found.what else { continue };
        let value = signals.each_ref().map(|signal| match law(&robot, signal) {
            What::Signal(Signal::Sum { of }) => of[0].1,
            _ => panic!("no sum"),
        });
        force += v3(value);
        moment += cross(at, &v3(value));
    }
    let expected = [
        [1.0500731497160998, 1.066276000884629, 3.4293442332584214],
        [3.2362898429299527, 4.184610855894216, 7.0391617640619515],
    ];
    for (found, expected) in [force, moment].into_iter().zip(expected) {
        assert!((found - v3(expected)).norm() < TOLERANCE, "{found}");
    }
}

/// A channel with one high side. MuJoCo's two rules for its volume give different results.
const CHANNEL: &str = r#"<mujoco><asset><mesh name="u" INERTIA scale="1 2 -1" refpos="0.05 0.02 0.01" refquat="0.5 0.5 0.1 0.7"
vertex="0 0 0 0.3 0 0 0.3 0.25 0 0.2 0.25 0 0.2 0.1 0 0.1 0.1 0 0.1 0.2 0 0 0.2 0 0 0 0.15 0.3 0 0.15 0.3 0.25 0.15 0.2 0.25 0.15 0.2 0.1 0.15 0.1 0.1 0.15 0.1 0.2 0.15 0 0.2 0.15"
face="0 4 1 8 9 12 1 4 2 9 10 12 2 4 3 10 11 12 0 5 4 8 12 13 0 6 5 8 13 14 0 7 6 8 14 15 0 1 9 0 9 8 1 2 10 1 10 9 2 3 11 2 11 10 3 4 12 3 12 11 4 5 13 4 13 12 5 6 14 5 14 13 6 7 15 6 15 14 7 0 8 7 8 15"/></asset>
<worldbody><body name="b" pos="0 0 1"><freejoint/><geom type="mesh" mesh="u" pos="0.1 0 0" quat="0.9 0.1 0.3 0.2" density="800"/></body></worldbody></mujoco>"#;

#[test]
fn masses_of_meshes_are_those_of_the_other_program() {
    /// MuJoCo stores vertices in single precision.
    const SINGLE: f64 = 3.0e-7;
    for (inertia, expected) in [
        (
            "exact",
            [
                13.20000127553943,
                0.161890717637123,
                -0.06140249110508287,
                0.8346765469934745,
                0.35415557959033583,
                0.21837153994386413,
                0.2785288644203172,
                0.04625373375523972,
                -0.13972806834618687,
                0.029423448390976936,
            ],
        ),
        (
            "legacy",
            [
                15.26562094643725,
                0.16858591758018288,
                -0.06377421563374332,
                0.8328220090472009,
                0.368631212621164,
                0.23009412336411258,
                0.29549260606844074,
                0.05039347851486916,
                -0.14346023081907727,
                0.03195860804104621,
            ],
        ),
    ] {
        let robot = robot(&CHANNEL.replace("INERTIA", &format!("inertia=\"{inertia}\"")));
        let mass = robot.links[1].mass.expect("mass");
        let found = [&[mass.mass][..], mass.center.as_slice(), &mass.six()].concat();
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < SINGLE * expected.abs().max(1.0),
                "{inertia}: {found} {expected}"
            );
        }
    }
}
