//! Rotors with other features: checkpoints, statics, mass matrices, couplings, guides in a chain.

use super::{head, initial, output, rotor, run};
use crate::common::oracle::{TRAPEZOIDAL, last};
use crate::common::{by, run as run_method};
use mbs::{Method, Tree};
use mbs_testkit::scene;

/// Scene of two hinges in a row with a rotor each; the first hinge may have a guide.
fn chain(first: &str) -> String {
    [
        head(2, "[0.0, -9.81]"),
        "[[body]]\nname = \"a\"\nmass = 2.0\ncenter = [0.5, 0.0]\ninertia = 0.1\n".into(),
        "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [1.5, 0.0]\ninertia = 0.05\n".into(),
        "[[joint]]\nname = \"p\"\nkind = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\n".into(),
        "[[joint]]\nname = \"q\"\nkind = \"revolute\"\nbodies = [\"a\", \"b\"]\nat = [1.0, 0.0]\n".into(),
        rotor("p", 1e-4, 100.0),
        rotor("q", 2e-4, 50.0),
        first.to_owned(),
    ]
    .concat()
}

#[test]
fn mass_matrix_and_inverse_dynamics_have_the_rotors() {
    let without = chain("").replace("[[effect]]\n", "[[effect]]\nenabled = false\n");
    let mut trees = [chain(""), without].map(|text| Tree::new(&scene(&text)).expect("a tree"));
    let mut found = Vec::new();
    for tree in &mut trees {
        tree.set(&[0.3, -0.8], &[1.5, 0.7]).expect("a state");
        let mass = tree.mass_matrix().data.clone();
        let bias = tree.bias_forces().to_vec();
        let effort = tree.inverse_dynamics(&[2.0, -3.0]).expect("two").to_vec();
        let back = tree.forward_dynamics(&effort).expect("two").to_vec();
        assert!((back[0] - 2.0).abs() < 1e-11 && (back[1] + 3.0).abs() < 1e-11, "{back:?}");
        found.push((mass, bias, effort));
    }
    let [(with, bias, effort), (mass, same_bias, smaller)] = &found[..] else { panic!("two") };
    // the rotors add 1e-4 * 100^2 and 2e-4 * 50^2 kg m^2
    for (k, more) in [1.0, 0.0, 0.0, 0.5].into_iter().enumerate() {
        assert!((with[k] - mass[k] - more).abs() < 1e-12, "{with:?}, {mass:?}");
    }
    for (k, more) in [2.0, -1.5].into_iter().enumerate() {
        assert!((effort[k] - smaller[k] - more).abs() < 1e-11, "{effort:?}, {smaller:?}");
        assert!((bias[k] - same_bias[k]).abs() < 1e-12, "{bias:?}, {same_bias:?}");
    }
}

#[test]
fn a_guided_joint_in_a_chain_has_the_effort_of_its_rotor_in_every_formulation() {
    let guide =
        "[[guide]]\njoint = \"p\"\nsine = { amplitude = 0.4, frequency = 0.5, phase = 0.3 }\n";
    let text =
        [chain(guide), output("p", "effort"), output("p", "acceleration"), output("q", "rate")]
            .concat();
    let off = text.replacen("[[effect]]\n", "[[effect]]\nenabled = false\n", 1);
    for formulation in TRAPEZOIDAL {
        let [with, without] = [&text, &off].map(|text| run(text, formulation, 1e-3, 0.3));
        for ((_, a), (_, b)) in with.iter().zip(&without) {
            // the motion is the same; the effort is larger by 1 kg m^2 times the acceleration
            assert!((a[2] - b[2]).abs() < 1e-9, "{formulation}: {a:?}, {b:?}");
            assert!((a[0] - b[0] - a[1]).abs() < 1e-7, "{formulation}: {a:?}, {b:?}");
        }
        let method = Method { step: Some(1e-3), duration: Some(0.3), ..by(formulation) };
        let energy = run_method(&scene(&text), &method).summary.energy.max_error;
        println!("{formulation}: {energy:.1e} J");
        assert!(energy < 1e-4, "{formulation}: {energy:e}");
    }
}

#[test]
fn a_rotor_beside_a_gear_adds_at_its_own_joint() {
    // two wheels of 0.1 and 0.4 kg m^2 have the angles a and b = -a / 2; the joint of b has a rotor of 0.25 kg m^2
    let text = [
        head(2, "[0.0, 0.0]"),
        "[[body]]\nname = \"a\"\nmass = 1.0\ncenter = [0.0, 0.0]\ninertia = 0.1\n".into(),
        "[[body]]\nname = \"b\"\nmass = 1.0\ncenter = [1.0, 0.0]\ninertia = 0.4\n".into(),
        "[[joint]]\nname = \"a\"\nkind = \"revolute\"\nbodies = [\"ground\", \"a\"]\nat = [0.0, 0.0]\n".into(),
        "[[joint]]\nname = \"b\"\nkind = \"revolute\"\nbodies = [\"ground\", \"b\"]\nat = [1.0, 0.0]\n".into(),
        "[[coupling]]\nname = \"mesh\"\nkind = \"gear\"\njoints = [\"a\", \"b\"]\nteeth = [20, 40]\n".into(),
        "[[effect]]\nkind = \"torque\"\njoint = \"a\"\nvalue = 0.6\n".into(),
        rotor("b", 1e-4, 50.0),
        output("a", "rate"),
        "[[output]]\nname = \"effort\"\ncoupling = \"mesh\"\nquantity = \"effort\"\n".into(),
    ]
    .concat();
    let acceleration = 0.6 / (0.1 + (0.4 + 0.25) / 4.0);
    // the effort is the torque of the coupling on wheel a
    let effort = (0.4 + 0.25) * -acceleration / 4.0;
    for formulation in TRAPEZOIDAL {
        let rows = run(&text, formulation, 1e-3 / 32.0, 1e-3);
        let row = last(&rows);
        let found = row[0] / 1e-3;
        assert!((found - acceleration).abs() < 1e-6, "{formulation}: {found}, {acceleration}");
        assert!((row[1] - effort).abs() < 1e-7, "{formulation}: {row:?}, {effort}");
    }
}

#[test]
fn rest_and_degrees_of_freedom_do_not_depend_on_rotors() {
    let text =
        [chain(&initial("p", -1.2, 0.0)), output("p", "value"), output("q", "value")].concat();
    let text = text.replace("rate = 0.0\n", "");
    let found = mbs::StaticEquilibrium::new(&scene(&text), mbs::Search::Down).expect("it rests");
    let [p, q] = [0, 1].map(|joint| found.joints[joint].1[0]);
    assert!((p + core::f64::consts::FRAC_PI_2).abs() < 1e-9 && q.abs() < 1e-9, "{p}, {q}");
    assert_eq!((found.unstable, found.neutral), (Some(0), Some(0)));
    // all rows are independent
    assert_eq!(found.sizes[1], found.sizes[2]);
    for formulation in TRAPEZOIDAL {
        let method = Method { step: Some(1e-3), duration: Some(0.01), ..by(formulation) };
        let outcome = run_method(&scene(&text), &method);
        assert_eq!(outcome.summary.dof, 2, "{formulation}");
    }
}
