//! Closed forms: small oscillations, constant accelerations, efforts of guides.

use super::{head, initial, output, rotor, run};
use crate::common::oracle::{TRAPEZOIDAL, last};
use mbs::{Modes, Place, Search};
use mbs_testkit::scene;

/// Relative error of accelerations from half a millisecond of a run [-]. Rounding divided by the step gives 1e-9.
const EXACT: f64 = 1e-8;

/// Scene of a pendulum on a hinge whose rotor adds ratio² inertia = 0.25 kg m^2, in the plane or in space about an oblique axis.
fn pendulum(dimension: usize, center: [f64; 2], inertia: f64, angle: f64) -> String {
    let [x, y] = center;
    // in space the plane of the motion is rotated about y, with sides of 3-4-5
    let (gravity, center, axis, tensor) = if dimension == 2 {
        ("[0.0, -9.81]", format!("[{x:?}, {y:?}]"), String::new(), format!("{inertia:?}"))
    } else {
        let i = inertia;
        (
            "[0.0, -9.81, 0.0]",
            format!("[{:?}, {y:?}, {:?}]", 0.8 * x, 0.6 * x),
            "axis = [-0.6, 0.0, 0.8]\n".to_owned(),
            format!("[{i:?}, {i:?}, {i:?}, 0.0, 0.0, 0.0]"),
        )
    };
    let at = if dimension == 2 { "[0.0, 0.0]" } else { "[0.0, 0.0, 0.0]" };
    [
        head(dimension, gravity),
        format!("[[body]]\nname = \"b\"\nmass = 1.0\ncenter = {center}\ninertia = {tensor}\n"),
        format!("[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = {at}\n{axis}"),
        rotor("a", 1e-4, 50.0),
        initial("a", angle, 0.0),
        output("a", "value"),
    ]
    .concat()
}

/// Point mass and uniform rod: centre [m], inertia [kg m^2] and angular frequency [rad/s].
const PENDULUMS: [([f64; 2], f64, f64); 2] =
    [([0.0, -1.0], 0.0, 2.801_428_207), ([0.0, -0.5], 1.0 / 12.0, 2.899_753_684)];

#[test]
fn modes_have_the_frequency_of_the_sum_of_inertias() {
    for (center, inertia, omega) in PENDULUMS {
        for dimension in [2, 3] {
            // a spatial body needs some inertia about its own axis
            if dimension == 3 && inertia == 0.0 {
                continue;
            }
            let scene = scene(&pendulum(dimension, center, inertia, 0.0));
            let modes = Modes::new(&scene, Place::Equilibrium, Search::Down).expect("it rests");
            assert_eq!(modes.modes.len(), 1, "{modes:?}");
            let found = modes.modes[0].imaginary;
            assert!((found - omega).abs() < 1e-9, "{dimension}: {found}, not {omega}");
        }
    }
}

#[test]
fn small_oscillations_have_the_frequency_of_the_sum_of_inertias() {
    let small = 1e-4;
    for (center, inertia, omega) in PENDULUMS {
        let text = pendulum(2, center, inertia, small);
        for formulation in TRAPEZOIDAL {
            let rows = run(&text, formulation, 1e-3, 2.0);
            let off = rows.iter().map(|(t, row)| (row[0] - small * (omega * t).cos()).abs());
            let worst = off.fold(0.0, f64::max);
            // the rule has a relative phase delay of (omega h)^2 / 12
            assert!(worst < 1e-5 * small, "{formulation}: {worst:e}");
        }
    }
}

/// Scene of a weight on a vertical slide; a rotor of 1e-4 kg m^2 at 100 rad/m adds 1 kg.
fn slide(inclined: bool, rest: &str) -> String {
    let axis = if inclined { "[0.6, 0.8]" } else { "[0.0, 1.0]" };
    [
        head(2, "[0.0, -9.81]"),
        "[[body]]\nname = \"b\"\nmass = 2.0\ncenter = [0.3, 0.1]\ninertia = 0.1\n".into(),
        format!("[[joint]]\nname = \"s\"\nkind = \"prismatic\"\nbodies = [\"ground\", \"b\"]\nat = [0.0, 0.0]\naxis = {axis}\n"),
        rotor("s", 1e-4, -100.0),
        output("s", "rate"),
        rest.to_owned(),
    ]
    .concat()
}

#[test]
fn a_rotor_on_a_slide_falls_with_it() {
    for (inclined, share) in [(false, 1.0), (true, 0.8)] {
        let a = -9.81 * share * 2.0 / 3.0;
        for formulation in TRAPEZOIDAL {
            let rows = run(&slide(inclined, ""), formulation, 1e-2, 1.0);
            let rate = last(&rows)[0];
            assert!((rate - a).abs() < 1e-9 * a.abs(), "{formulation}: {rate}, not {a}");
        }
    }
}

/// Scene of a housing on a free hinge, 0.28 kg m^2 about it, with a wheel of 0.02 kg m^2 on a shaft. The motor acts between both.
fn housing() -> String {
    [
        head(2, "[0.0, 0.0]"),
        "[[body]]\nname = \"housing\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.28\n".into(),
        "[[body]]\nname = \"wheel\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.02\n".into(),
        "[[joint]]\nname = \"h\"\nkind = \"revolute\"\nbodies = [\"ground\", \"housing\"]\nat = [0.0, 0.0]\n".into(),
        "[[joint]]\nname = \"w\"\nkind = \"revolute\"\nbodies = [\"housing\", \"wheel\"]\nat = [0.0, 0.0]\n".into(),
        "[[effect]]\nkind = \"torque\"\njoint = \"w\"\nvalue = 0.8\n".into(),
        rotor("w", 1e-4, 50.0),
        output("h", "rate"),
        output("w", "rate"),
    ]
    .concat()
}

#[test]
fn a_housing_that_is_free_to_turn_gets_the_torque_of_the_wheel_alone() {
    // the angles h of the housing and w of the wheel have the equations [[0.3, J], [J, J + I]] (h, w)'' = (0, 0.8), J = 0.02, I = 0.25 kg m^2
    let (j, i) = (0.02, 0.25);
    let det = 0.3 * (j + i) - j * j;
    let right = [-j * 0.8 / det, 0.3 * 0.8 / det];
    let duration = 5e-4;
    for formulation in TRAPEZOIDAL {
        let rows = run(&housing(), formulation, duration / 16.0, duration);
        for (found, right) in last(&rows).iter().zip(right) {
            let found = found / duration;
            assert!((found - right).abs() < EXACT * right.abs(), "{formulation}: {found}, {right}");
        }
    }
}

#[test]
fn a_guide_moves_the_rotor_too() {
    // the guide has the acceleration f'' = -a w^2 sin(w t), with amplitude a and angular frequency w
    let guide = "[[guide]]\njoint = \"JOINT\"\nsine = { amplitude = 0.3, frequency = 0.7 }\n";
    let effort = |joint| output(joint, "effort");
    let turn = [
        head(2, "[0.0, 0.0]"),
        "[[body]]\nname = \"b\"\nmass = 2.0\ncenter = [0.5, 0.0]\ninertia = 0.1\n".into(),
        "[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [0.0, 0.0]\n".into(),
        rotor("a", 1e-4, 50.0),
        guide.replace("JOINT", "a"),
        effort("a"),
        output("a", "reaction"),
    ]
    .concat();
    let line =
        slide(false, &[guide.replace("JOINT", "s"), effort("s")].concat()).replace("-9.81", "0.0");
    let w = 0.7 * core::f64::consts::TAU;
    for (text, at, inertia) in [(&turn, 0, 0.6 + 0.25), (&line, 1, 3.0)] {
        for formulation in TRAPEZOIDAL {
            let rows = run(text, formulation, 1e-3, 0.4);
            let (t, row) = rows.last().expect("a row");
            let right = -inertia * 0.3 * w * w * (w * t).sin();
            assert!(
                (row[at] - right).abs() < 1e-5 * right.abs(),
                "{formulation}: {row:?}, {right}"
            );
            if row.len() > 3 {
                assert!((row[3] - right).abs() < 1e-5 * right.abs(), "{formulation}: {row:?}");
            }
        }
    }
}

#[test]
fn a_wheel_counts_its_turns_and_books_its_energy() {
    // 1 kg m^2 and a rotor of 0.25 kg m^2: 2.5 N m give 2 rad/s^2
    let text = [
        head(2, "[0.0, 0.0]"),
        "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 1.0\n".into(),
        "[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"b\", \"ground\"]\nat = [0.0, 0.0]\n".into(),
        "[[effect]]\nkind = \"torque\"\njoint = \"a\"\nvalue = 2.5\n".into(),
        rotor("a", 1e-4, 50.0),
        initial("a", 9.0, 3.0),
        output("a", "value"),
        "[[output]]\nname = \"e\"\nquantity = \"kinetic-energy\"\n".into(),
        "[[output]]\nname = \"all\"\nquantity = \"energy\"\n".into(),
        "[[output]]\nname = \"l\"\nquantity = \"angular-momentum\"\n".into(),
        ["force", "value", "rate", "energy", "power"].map(|quantity| format!(
            "[[output]]\nname = \"{quantity}\"\neffect = \"rotor-a\"\nquantity = \"{quantity}\"\n"
        )).concat(),
    ]
    .concat();
    for formulation in TRAPEZOIDAL {
        let rows = run(&text, formulation, 1e-3, 4.0);
        for (t, row) in [&rows[0], rows.last().expect("a row")] {
            let (angle, rate) = (9.0 + 3.0 * t + t * t, 3.0 + 2.0 * t);
            let energy = 0.625 * rate * rate;
            let right =
                [angle, energy, energy, -rate, 0.5, angle, rate, 0.125 * rate * rate, -0.5 * rate];
            for (k, (found, right)) in row.iter().zip(right).enumerate() {
                // rotating directions have a relative phase delay of (rate h)^2 / 12
                let off = (found - right).abs() / right.abs();
                assert!(off < 5e-5, "{formulation}, {t} s, {k}: {row:?}, {right}");
            }
        }
    }
}
