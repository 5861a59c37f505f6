//! Relations with other features: statics, modes, precisions, threads, snapshots, no allocation.

use super::{Ellipse, Product, of_joints, run, scene, slides};
use crate::common::allocations;
use crate::common::oracle::{TRAPEZOIDAL, Way, last};
use mbs::core::scene::Scene;
use mbs::typed::Simulation;
use mbs::{
    Body, Coupling, EquilibriumOptions, FormulationKind, GROUND, IntegratorKind, Joint, JointId,
    Mechanism, Method, Precision, ResolvedMethod, Snapshot, equilibrium, modes,
};

/// Mechanism of three slides along oblique axes in space, with (1 + x)(1 + y)(1 + z) = 1.
fn three() -> (Mechanism, [JointId; 3]) {
    let mut m = Mechanism::spatial("three slides");
    m.set_gravity([1.0, 2.0, -9.0]).set_duration(0.3);
    let axes = [[0.48, 0.64, 0.6], [0.8, -0.6, 0.0], [-0.36, -0.48, 0.8]];
    let joints = axes.map(|axis| {
        let body = m.add(Body::spatial([0.0; 3], 1.0, [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]));
        m.add(Joint::prismatic([GROUND, body], [0.0; 3]).along(axis))
    });
    m.add(Coupling::relation(joints, Product).holding(1.0).named("track"));
    (m, joints)
}

fn values(m: &Mechanism, sim: &mbs::Simulation) -> Vec<f64> {
    m.ids::<JointId>().flat_map(|joint| [sim.value(joint), sim.rate(joint)]).collect()
}

#[test]
fn a_bead_rests_at_the_lowest_point_of_its_ellipse_and_swings_there_as_its_equation_says() {
    // the bead moves along y on the carrier, perpendicular to the carrier's x: x = a (cos s - 1)
    let (a, b, g) = (0.7, 0.4, 9.81);
    for axes in [[[0.6, 0.8], [-0.8, 0.6]], [[1.0, 0.0], [0.0, 1.0]]] {
        let mut m = Mechanism::planar("bead");
        // gravity acts along the second slide, in its negative direction
        m.set_gravity(axes[1].map(|x| -g * x));
        let carrier = m.add(Body::planar([0.0, 0.0], 0.5, 0.1));
        let bead = m.add(Body::planar([0.0, 0.0], 0.8, 0.1));
        let first = m.add(Joint::prismatic([GROUND, carrier], [0.0, 0.0]).along(axes[0]));
        let second = m.add(Joint::prismatic([carrier, bead], [0.0, 0.0]).along(axes[1]));
        m.add(Coupling::relation([first, second], Ellipse([a, b])).holding(1.0));
        let rest = equilibrium(&m, &EquilibriumOptions::default()).expect("it rests");
        let joints = &rest.joints;
        // the equilibrium is at s = -90 degrees
        assert!((joints[0].1[0] + a).abs() < 1e-9, "{joints:?}");
        assert!((joints[1].1[0] + b).abs() < 1e-9, "{joints:?}");
        assert_eq!(rest.unstable, Some(0));
        let found = modes(&m, &rest).expect("it swings");
        assert_eq!(found.modes.len(), 1);
        // a small motion has the equation (m + M) a^2 s'' = -m g b (s + pi/2), with the masses m of the bead and M of the carrier
        let right = (0.8 * g * b / (1.3 * a * a)).sqrt() / core::f64::consts::TAU;
        // numerical derivatives of forces have ten digits
        let frequency = found.modes[0].frequency();
        assert!((frequency - right).abs() < 1e-7, "{frequency} {right}");
    }
}

#[test]
fn single_precision_moves_as_doubles_do() {
    let (m, _) = three();
    let of = |integrator| Method::new(FormulationKind::Recursive).integrator(integrator);
    let methods = FormulationKind::ALL.map(Method::new).into_iter();
    for method in methods.chain([of(IntegratorKind::Rk4), of(IntegratorKind::Extrapolation)]) {
        let end = |precision| {
            let mut sim = m.simulate(&method.clone().precision(precision)).ok()?;
            sim.advance_to(0.3).unwrap_or_else(|e| panic!("{method:?}, {precision:?}: {e}"));
            Some(values(&m, &sim))
        };
        let Some(doubles) = end(Precision::F64) else { continue };
        // single precision has seven digits, some of which are lost in 300 steps
        for (x, y) in end(Precision::F32).into_iter().flatten().zip(&doubles) {
            assert!((x - y).abs() < 2e-2, "{method:?}: {x} {y}");
        }
    }
}

#[test]
fn runs_of_32_digits_refuse_a_relation_which_gives_16() {
    let (m, _) = three();
    let method = Method::new(FormulationKind::Recursive).precision(Precision::DoubleDouble);
    let error = m.simulate(&method).expect_err("it has 16 digits").to_string();
    // the message depends on whether this precision is built
    let is_built = !error.contains("this build has no precision");
    assert!(!is_built || error.contains("gives doubles, 16 digits"), "{error}");
}

#[test]
fn a_run_from_a_snapshot_has_the_bits_of_the_run_in_one_go() {
    let (m, _) = three();
    for formulation in FormulationKind::ALL {
        let mut sim = m.simulate(&Method::new(formulation)).expect("it starts");
        sim.advance_to(0.1).unwrap_or_else(|e| panic!("{formulation:?}: {e}"));
        let bytes = sim.save().expect("a snapshot").to_bytes();
        let mut again = m.simulate(&Method::new(formulation)).expect("it starts");
        again.restore(&Snapshot::from_bytes(&bytes).expect("ours")).expect("the same mechanism");
        for sim in [&mut sim, &mut again] {
            sim.advance_to(0.2).unwrap_or_else(|e| panic!("{formulation:?}: {e}"));
        }
        assert_eq!(values(&m, &sim), values(&m, &again), "{formulation:?}");
    }
}

/// Scene of many pairs of slides in a row, each pair on the one before, with a relation each.
fn row(n: usize) -> Scene<f64> {
    let names: Vec<[String; 2]> = (0..n).map(|i| [format!("a{i}"), format!("b{i}")]).collect();
    let mut bodies = Vec::new();
    for (i, [a, b]) in names.iter().enumerate() {
        let on = if i == 0 { "ground" } else { names[i - 1][1].as_str() };
        bodies.push((a.as_str(), 1.0, on, [0.8, 0.6, 0.0]));
        bodies.push((b.as_str(), 0.5, a.as_str(), [-0.6, 0.8, 0.0]));
    }
    let couplings = (0..n).map(|i| {
        let of = of_joints(&[2 * i, 2 * i + 1], Product).holding(1.0);
        of.named(&format!("held-{i}"))
    });
    scene(&slides(2, [1.0, -3.0, 0.0], &bodies), couplings)
}

#[test]
fn threads_change_no_bit_of_a_mechanism_with_relations() {
    let scene = row(40);
    for formulation in ["index-3", "index-1", "classical"] {
        let bits = |threads: usize| {
            let named = Some(formulation.to_owned());
            let method = Method { formulation: named, threads: Some(threads), ..Method::default() };
            let settings = ResolvedMethod::new(&scene, &method).expect("settings");
            let mut sim = Simulation::<f64, 2>::new(&scene, &settings).expect("it starts");
            for _ in 0..10 {
                sim.step(1e-3).unwrap_or_else(|e| panic!("{formulation:?}: {e}"));
            }
            sim.state().q.iter().map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        let one = bits(1);
        for threads in [2, 3] {
            assert!(one == bits(threads), "{formulation}, {threads} threads");
        }
    }
}

#[test]
fn a_step_with_relations_allocates_nothing() {
    let scene = row(3);
    for formulation in TRAPEZOIDAL {
        let method = Method { formulation: Some(formulation.to_owned()), ..Method::default() };
        let settings = ResolvedMethod::new(&scene, &method).expect("settings");
        let mut sim = Simulation::<f64, 2>::new(&scene, &settings).expect("it starts");
        for _ in 0..3 {
            sim.step(1e-3).unwrap_or_else(|e| panic!("{formulation}: {e}"));
        }
        let before = allocations::count();
        for _ in 0..20 {
            let made = sim.step(1e-3);
            assert!(made.is_ok(), "{formulation}");
        }
        assert_eq!(allocations::count(), before, "{formulation}");
    }
}

#[test]
fn chains_of_relations_agree_between_the_tree_and_natural_coordinates() {
    let scene = row(4);
    let end = |way| last(&run(&scene, way, 2.5e-4, 0.1, 1)).to_vec();
    let right = end(Way("recursive", "rk853"));
    for formulation in TRAPEZOIDAL {
        for (x, y) in end(Way(formulation, "trapezoidal")).iter().zip(&right) {
            // the error of the rule is of order h^2
            assert!((x - y).abs() < 1e-5 * (1.0 + y.abs()), "{formulation}: {x} {y}");
        }
    }
}

#[test]
fn coordinates_of_a_joint_with_several_are_numbers_of_a_relation() {
    // a bead that moves freely in the plane, on an ellipse by x and y of its joint
    let text = "[scene]\nname = \"p\"\ndimension = 2\nduration = 1.0\ngravity = [0.0, -9.81]\n[[body]]\nname = \"bead\"\nmass = 1.0\ncenter = [0.7, 0.0]\ninertia = 0.1\n[[joint]]\nname = \"x\"\nkind = \"free\"\nbodies = [\"ground\", \"bead\"]\nat = [0.7, 0.0]\n[[output]]\nname = \"p\"\nbody = \"bead\"\nat = [0.7, 0.0]\n";
    let joint = JointId::new(0);
    let of = Coupling::relation([(joint, 0), (joint, 1)], Ellipse([0.7, 0.4])).holding(1.0);
    let scene = scene(text, [of]);
    for formulation in ["index-3", "index-1", "classical", "state-space"] {
        for (t, row) in run(&scene, Way(formulation, "trapezoidal"), 1e-3, 0.3, 1) {
            let off = (row[0] / 0.7).powi(2) + (row[1] / 0.4).powi(2) - 1.0;
            assert!(off.abs() < 1e-10, "{formulation}, {t}: {row:?}");
        }
    }
}
