//! Invariance of a motion under changes of axes, of the order of bodies, of the order of bodies in a joint, and of precision. Bodies at
//! equilibrium stay at rest.

use mbs_augmented::{Options, Workspace, index1, index3};
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{InitialTarget, Scene};
use mbs_core::step::Step;
use mbs_testkit::retell::{reorder, turn_scene, turned};
use mbs_testkit::scenes::{CHAIN, DOUBLE, REDUNDANT, TOP, TWO_FOUR_BARS};
use mbs_testkit::{named_centres, scene, scene_in, solver, start, start_in};

/// Allowed growth of rounding errors over some hundred steps of a regular motion [m].
const ROUNDING: f64 = 1e-9;
/// Allowed error of single precision after half a second [m].
const SINGLE: f64 = 1e-3;

fn run<T: Real, const D: usize>(
    scene: &Scene<T>,
    dt: f64,
    steps: u32,
) -> (NaturalModel<T, D>, State<T>) {
    let (model, mut state) = start_in::<T, D>(scene);
    let mut w = Workspace::new(&model, solver(&model));
    let options = Options::<T>::index3();
    for i in 0..steps {
        index3::step(
            &model,
            Step { dt: T::from_f64(dt), length: model.length() },
            &options,
            &mut state,
            &mut w,
        )
        .unwrap_or_else(|e| panic!("{}: step {i}: {e}", scene.name));
    }
    (model, state)
}

#[track_caller]
fn same(a: &[(String, [f64; 3])], b: &[(String, [f64; 3])], tolerance: f64) {
    for ((name, a), (_, b)) in a.iter().zip(b) {
        for k in 0..3 {
            assert!((a[k] - b[k]).abs() <= tolerance, "{name}: {a:?} against {b:?}");
        }
    }
}

#[test]
fn a_turned_scene_moves_alike() {
    for text in [&*CHAIN, &REDUNDANT, &TOP] {
        let plain = scene(text);
        let other = turn_scene(&plain);
        let (model, state) = run::<f64, 3>(&plain, 1e-3, 200);
        let expected: Vec<_> = named_centres(&plain, &model, &state)
            .into_iter()
            .map(|(n, p)| (n, turned(p)))
            .collect();
        let (model, state) = run::<f64, 3>(&other, 1e-3, 200);
        same(&named_centres(&other, &model, &state), &expected, ROUNDING);
    }
}

#[test]
fn the_order_of_bodies_does_not_matter() {
    for text in [&*CHAIN, &REDUNDANT] {
        let plain = scene(text);
        let other = reorder(&plain);
        let (model, state) = run::<f64, 3>(&plain, 1e-3, 200);
        let expected = named_centres(&plain, &model, &state);
        let (model, state) = run::<f64, 3>(&other, 1e-3, 200);
        same(&named_centres(&other, &model, &state), &expected, ROUNDING);
    }
}

#[test]
fn a_joint_written_the_other_way_round_moves_alike_with_negated_values() {
    let plain = scene(&REDUNDANT);
    let mut other = plain.clone();
    for joint in &mut other.joints {
        joint.bodies.swap(0, 1);
    }
    for initial in &mut other.initials {
        if let InitialTarget::Joint { value, rate, .. } = &mut initial.target {
            for x in [value, rate].into_iter().flatten().flatten() {
                *x = -*x;
            }
        }
    }
    let (model, state) = run::<f64, 3>(&plain, 1e-3, 200);
    let expected = named_centres(&plain, &model, &state);
    let (model, state) = run::<f64, 3>(&other, 1e-3, 200);
    same(&named_centres(&other, &model, &state), &expected, ROUNDING);
}

#[test]
fn single_precision_stays_near_double_precision() {
    let (double, single) = (scene(&DOUBLE), scene_in::<f32>(&DOUBLE));
    let (model, state) = run::<f64, 2>(&double, 2e-3, 250);
    let expected = named_centres(&double, &model, &state);
    let (model, state) = run::<f32, 2>(&single, 2e-3, 250);
    same(&named_centres(&single, &model, &state), &expected, SINGLE);
    let (double, single) = (scene(&TOP), scene_in::<f32>(&TOP));
    let (model, state) = run::<f64, 3>(&double, 1e-3, 500);
    let expected = named_centres(&double, &model, &state);
    let (model, state) = run::<f32, 3>(&single, 1e-3, 500);
    same(&named_centres(&single, &model, &state), &expected, SINGLE);
}

/// Scenes at equilibrium: hanging, standing and floating bodies.
const AT_REST: [&str; 4] = [
    "[scene]\nname = \"hanging rod\"\ndimension = 2\ngravity = [3.0, -4.0]\nduration = 1.0\n[[body]]\nname = \"x\"\nrod = { from = [0.0, 0.0], to = [0.6, -0.8] }\nmass = 1.3\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.0, 0.0]\n",
    "[scene]\nname = \"hanging chain\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nrod = { from = [0.1, 0.0], to = [0.1, -0.7] }\nmass = 1.3\n[[body]]\nname = \"y\"\nrod = { from = [0.1, -0.7], to = [0.1, -1.3] }\nmass = 0.7\n[[joint]]\nname = \"j\"\nkind = \"revolute\"\nbodies = [\"ground\", \"x\"]\nat = [0.1, 0.0]\n[[joint]]\nname = \"k\"\nkind = \"revolute\"\nbodies = [\"x\", \"y\"]\nat = [0.1, -0.7]\n",
    "[scene]\nname = \"spring\"\ndimension = 2\ngravity = [0.0, -9.81]\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 1.3\ncenter = [0.3, 0.0]\ninertia = 0.1\n[[effect]]\nkind = \"spring-damper\"\nbodies = [\"ground\", \"x\"]\npoints = [[0.3, 1.1], [0.3, 0.0]]\nstiffness = 127.53\nfree_length = 1.0\n",
    "[scene]\nname = \"drifting\"\ndimension = 3\nduration = 1.0\n[[body]]\nname = \"x\"\nmass = 1.3\ncenter = [0.3, 0.0, 0.1]\ninertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]\n[[initial]]\nbody = \"x\"\nat = [0.3, 0.0, 0.1]\nvelocity = [0.1, 0.2, 0.3]\nangular_velocity = [0.0, 0.0, 0.0]\n",
];

#[test]
fn what_is_at_rest_stays_at_rest() {
    for (i, text) in AT_REST.iter().enumerate() {
        for dt in [1e-2, 1e-3, 1e-4] {
            let norm = |v: &[f64]| v.iter().fold(0.0_f64, |s, v| s.max(v.abs()));
            if i < 3 {
                let (_, state) = run::<f64, 2>(&scene(text), dt, 100);
                assert!(norm(&state.v) < 1e-12, "{i}: {}", norm(&state.v));
            } else {
                let (_, state) = run::<f64, 3>(&scene(text), dt, 100);
                assert!((norm(&state.v) - 0.3).abs() < 1e-12 && norm(&state.a) < 1e-12);
            }
        }
    }
}

#[test]
fn index1_holds_what_is_at_rest_too() {
    let scene = scene(AT_REST[1]);
    let (model, mut state) = start::<2>(&scene);
    let mut w = Workspace::new(&model, solver(&model));
    for _ in 0..100 {
        index1::step(
            &model,
            Step { dt: 1e-3, length: model.length() },
            &Options::index1(),
            &mut state,
            &mut w,
        )
        .unwrap();
    }
    assert!(state.v.iter().all(|v| v.abs() < 1e-12));
}

#[test]
fn two_four_bars_pass_their_singular_positions() {
    // Limit [J]: twice the trapezoidal rule's error of 8.3e-4 J at this step.
    const ENERGY: f64 = 1.7e-3;
    let scene = scene(&TWO_FOUR_BARS);
    let energy = |steps| {
        let (model, state) = run::<f64, 2>(&scene, 1e-3, steps);
        model.kinetic_energy(&state.v) + model.potential_energy(&state.q, &model.terms())
    };
    let start = energy(0);
    for steps in [700, 2500] {
        assert!((energy(steps) - start).abs() < ENERGY, "after {steps} steps");
    }
}
