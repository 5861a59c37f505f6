//! Mechanisms with guided ball joints and other joints, a hexapod, equilibrium and modes.

use super::kinematics::{Vector, add, minus, rotation, spin_of, times, transposed};
use super::{Rows, SIX, WAYS, Way, head, off, oracle, output, signals, turning};
use crate::common::{self, dot};
use mbs::{Method, Modes, Place, Search};
use mbs_testkit::scene;

/// Scene of a heavy arm that swings about an oblique axis. A joint on it has `n` guided coordinates. `is_turned` exchanges the joint's
/// bodies.
fn on_an_arm(kind: &str, axes: &str, n: usize, is_turned: bool) -> String {
    let (sines, names) = signals(&SIX[6 - n..]);
    let bodies = if is_turned { "[\"body\", \"arm\"]" } else { "[\"arm\", \"body\"]" };
    [
        head(3, "[0.0, 0.0, -9.81]"),
        "[[body]]\nname = \"arm\"\nmass = 9.0\ncenter = [0.5, 0.1, 0.2]\ninertia = [0.5, 0.9, 0.8, 0.1, 0.0, -0.1]\n".into(),
        "[[body]]\nname = \"body\"\nmass = 0.7\ncenter = [1.2, 0.2, 0.1]\ninertia = [0.02, 0.03, 0.04, 0.0, 0.005, 0.0]\n".into(),
        "[[joint]]\nname = \"hinge\"\nkind = \"revolute\"\nbodies = [\"ground\", \"arm\"]\nat = [0.0, 0.0, 0.0]\n".into(),
        "axis = [0.48, 0.6, 0.64]\n".into(),
        format!("[[joint]]\nname = \"j\"\nkind = \"{kind}\"\nbodies = {bodies}\nat = [1.0, 0.1, 0.3]\n{axes}\n"),
        format!("[[guide]]\njoint = \"j\"\nsignals = {names}\n"),
        sines,
        output("joint = \"j\"", "", "value"),
        output("joint = \"j\"", "", "effort"),
        output("joint = \"hinge\"", "", "value"),
    ]
    .concat()
}

/// Kinds of joints with several coordinates: kind, text of its axes, and number of coordinates.
const KINDS: [(&str, &str, usize); 6] = [
    ("spherical", "", 3),
    ("free", "", 6),
    ("universal", "axes = [[0.6, 0.0, 0.8], [0.3, 0.9, -0.2]]", 2),
    ("cylindrical", "axis = [0.6, 0.48, 0.64]", 2),
    ("planar", "axis = [0.6, 0.48, 0.64]\ndirection = [0.8, -0.3, 0.1]", 3),
    ("pin-in-slot", "axis = [0.6, 0.48, 0.64]", 4),
];

#[test]
fn every_joint_with_several_coordinates_is_guided_whole_either_way_round() {
    for (kind, axes, n) in KINDS {
        for is_turned in [false, true] {
            let text = on_an_arm(kind, axes, n, is_turned);
            let exact = oracle::run(&text, Way("recursive", "rk853"), (1e-3, 0.3));
            for way in WAYS {
                let rows = oracle::run(&text, way, (1e-3, 0.3));
                // at the start nothing is integrated: efforts depend on one instant only
                let [first, start] = [&rows, &exact].map(|rows| &rows[0].1);
                let from = format!("{kind} {is_turned} {way:?}");
                assert!(off(first, start) < 1e-7, "{from}: {first:?} {start:?}");
                for (t, row) in &rows {
                    let values: Vec<f64> = SIX[6 - n..].iter().map(|sine| sine.at(*t)).collect();
                    assert!(off(&row[..n], &values) < 1e-9, "{from} at {t}: {row:?} {values:?}");
                }
                // with steps of 1 ms the swing of the arm has an error of second order
                let ends = [&rows, &exact].map(|rows: &Rows| oracle::last(rows)[2 * n]);
                assert!((ends[0] - ends[1]).abs() < 5e-4, "{from}: {ends:?}");
            }
        }
    }
}

#[test]
fn efforts_of_a_guided_ball_turn_the_arm_that_carries_it() {
    // only the work of the guide changes the energy of arm and body
    for is_turned in [false, true] {
        let scene = scene(&on_an_arm("spherical", "", 3, is_turned));
        let error = |way: Way, step: f64| {
            let method = Method {
                formulation: Some(way.0.to_owned()),
                integrator: Some(way.1.to_owned()),
                step: Some(step),
                duration: Some(0.5),
                ..Method::default()
            };
            let outcome = common::run(&scene, &method);
            assert!(outcome.error.is_none(), "{way:?}");
            outcome.summary.energy.max_error
        };
        for way in WAYS {
            let errors = [5e-4, 2.5e-4].map(|step| error(way, step));
            println!("{is_turned} {way:?}: {errors:?} J");
            if way.1 == "rk853" {
                assert!(errors[1] < 1e-9, "{errors:?}");
            } else {
                let ratio = errors[0] / errors[1];
                assert!((3.6..4.4).contains(&ratio), "{way:?}: {errors:?}");
            }
        }
    }
}

#[test]
fn a_guided_ball_turns_a_body_by_the_exponential_of_its_rotation_vector_through_three_turns() {
    let text = [
        on_an_arm("spherical", "", 3, false),
        output("body = \"body\"", "", "angular-velocity"),
        output("body = \"arm\"", "", "angular-velocity"),
        output("body = \"body\"", "at = [1.0, 0.1, 0.3]", "position"),
        output("body = \"body\"", "at = [1.2, 0.5, 0.1]", "position"),
    ]
    .concat();
    let axis = [0.48, 0.6, 0.64];
    let motion = turning();
    let largest = (0..=1000).map(|k| f64::from(k) * 1e-3);
    let largest = largest.map(|t| motion.rotation.map(|sine| sine.at(t)));
    assert!(largest.map(|f| dot(f, f).sqrt()).fold(0.0, f64::max) > 3.0 * std::f64::consts::TAU);
    for way in WAYS {
        for (t, row) in oracle::run(&text, way, (1e-3, 1.0)).iter().step_by(20) {
            let at = |i: usize| [row[i], row[i + 1], row[i + 2]];
            let arm = rotation(axis.map(|x: f64| x * row[6]));
            let own = motion.rotation_at(*t);
            let p: Vector = minus([1.2, 0.5, 0.1], [1.0, 0.1, 0.3]);
            let place = times(&arm, add([1.0, 0.1, 0.3], times(&own, p)));
            assert!(off(&at(16), &place) < 1e-10, "{way:?} at {t}: {:?} {place:?}", at(16));
            let relative = times(&transposed(&arm), minus(at(7), at(10)));
            let spin = spin_of(|t| motion.rotation_at(t), *t);
            assert!(off(&relative, &spin) < 1e-9, "{way:?} at {t}: {relative:?} {spin:?}");
        }
    }
}

#[test]
fn a_guided_mechanism_has_as_many_freedoms_as_its_free_joints() {
    let dof = |name: &str| {
        let scene = if name == "hexapod" {
            common::scene(name)
        } else {
            scene(&on_an_arm(name, "", if name == "free" { 6 } else { 3 }, false))
        };
        ["index-3", "recursive"].map(|f| {
            let outcome = common::run_in(&scene, f, Some(1e-2));
            assert!(outcome.error.is_none(), "{name} {f}");
            outcome.summary.dof
        })
    };
    assert_eq!(dof("hexapod"), [0, 0]);
    assert_eq!(dof("spherical"), [1, 1]);
    assert_eq!(dof("free"), [1, 1]);
}

#[test]
fn rest_and_modes_hold_a_tilted_platform() {
    // the platform tilts a hinge by beta from the horizontal: the pendulum rests below it, and gravity in its plane is g cos beta
    let (beta, mass, arm, inertia) = (0.5_f64, 2.0, 0.4, 0.03);
    let constant = |name: char, value: f64| {
        format!("[[signal]]\nname = \"{name}\"\nkind = \"constant\"\nvalue = {value:?}\n")
    };
    let text = [
        head(3, "[0.0, 0.0, -9.81]"),
        "[[body]]\nname = \"p\"\nmass = 5.0\ncenter = [0.0, 0.0, 0.0]\ninertia = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0]\n".into(),
        format!("[[body]]\nname = \"b\"\nmass = {mass:?}\ncenter = [0.1, 0.0, -{arm:?}]\n"),
        format!("inertia = [{inertia:?}, {inertia:?}, {inertia:?}, 0.0, 0.0, 0.0]\n"),
        "[[joint]]\nname = \"h\"\nkind = \"revolute\"\nbodies = [\"p\", \"b\"]\nat = [0.1, 0.0, 0.0]\naxis = [1.0, 0.0, 0.0]\n".into(),
        "[[guide]]\nbody = \"p\"\nsignals = [\"x\", \"y\", \"z\", \"a\", \"b\", \"c\"]\n".into(),
        constant('x', 0.1),
        constant('y', -0.2),
        constant('z', 0.3),
        constant('a', 0.0),
        constant('b', beta),
        constant('c', 0.0),
    ]
    .concat();
    let modes = Modes::new(&scene(&text), Place::Equilibrium, Search::Down).expect("it rests");
    assert_eq!(modes.modes.len(), 1, "{modes:?}");
    let omega = (mass * 9.81 * beta.cos() * arm / (inertia + mass * arm * arm)).sqrt();
    let found = modes.modes[0].imaginary;
    assert!((found - omega).abs() < 1e-9, "{found}, not {omega}");
}
