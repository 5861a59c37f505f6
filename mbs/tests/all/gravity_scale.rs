//! Key `gravity_scale` of bodies, a factor of gravity, in every formulation and in all quantities of a tree.

use crate::common::oracle::{disagreement, everything, methods, rows_with_errors};
use crate::common::scene as shared;
use crate::tree::{mechanisms, tree, wandering};
use mbs::core::scene::Scene;
use mbs::{Effect, Mechanism, Method, Signal};
use mbs_testkit::random::Random;
use mbs_testkit::{close, dot, file};

/// Relative rounding error through trees of some bodies [-].
const ROUNDING: f64 = 1e-11;
/// Half of a step of the differences. Their error is of fourth order, plus rounding divided by the step.
const STEP: f64 = 1e-3;

/// Returns the scene with different factors of gravity, including zero and negative ones.
pub(crate) fn lightened(scene: &Scene<f64>) -> Scene<f64> {
    let mut scene = scene.clone();
    let factors = [Some(0.3), None, Some(-0.5), Some(0.0), Some(1.0)];
    for (body, factor) in scene.bodies.iter_mut().zip(factors.into_iter().cycle()) {
        body.gravity_scale = factor;
    }
    scene
}

#[test]
fn every_formulation_has_the_same_motion_and_energies_under_factors_of_gravity() {
    for name in ["double-pendulum", "four-bar", "slider-crank", "rssr"] {
        let scene = everything(&lightened(&shared(name)));
        let rows = |way| rows_with_errors(&scene, way, (1e-3, 0.2));
        let reference = rows(methods()[0]).unwrap_or_else(|e| panic!("{name}: {e}"));
        for way in &methods()[1..] {
            let found = rows(*way).unwrap_or_else(|e| panic!("{name} {}: {e}", way.0));
            let (ratio, component) = disagreement(&reference, &found);
            assert!(ratio <= 1.0, "{name} {} {}: {ratio} of {component}", way.0, way.1);
        }
    }
}

#[test]
fn a_factor_is_the_same_as_a_force_that_carries_the_rest_of_the_weight() {
    // one mechanism has the key with the factor s; another has a constant upward force m g (1 − s) at the centre
    let mut light =
        Mechanism::parse(include_str!("../../../scenes/double-pendulum.toml")).expect("a scene");
    let mut carried = light.clone();
    let lower = light.find::<mbs::BodyId>("lower").expect("a body");
    light.part_mut(lower).gravity_scale = Some(0.25.into());
    let force = Signal::from([0.0, 0.75 * 9.81]);
    carried.add(Effect::force(lower, [1.5, 0.0], force));
    let end = |m: &Mechanism| {
        let mut sim = m.simulate(&Method::default()).expect("a start");
        sim.advance_to(0.5).expect("steps");
        let mut tree = m.tree().expect("a tree");
        tree.follow(&sim).expect("the same mechanism");
        tree.coordinates().to_vec()
    };
    close("q", &end(&light), &end(&carried), ROUNDING);
}

#[test]
fn efforts_against_gravity_are_the_change_of_the_potential_energy() {
    for scene in mechanisms().iter().map(lightened) {
        let mut tree = wandering(&scene, 11);
        let (q, n) = (tree.coordinates().to_vec(), tree.velocities().len());
        let gravity = tree.gravity_forces().to_vec();
        let mut energy = |k: usize, h: f64| {
            let (mut step, mut there) = (vec![0.0; n], q.clone());
            step[k] = h;
            tree.integrate(&q, &step, &mut there).expect("a step");
            tree.set(&there, &vec![0.0; n]).expect("a state");
            tree.energies()[1]
        };
        let slopes: Vec<f64> = (0..n)
            .map(|k| {
                let near = energy(k, STEP) - energy(k, -STEP);
                let far = energy(k, 2.0 * STEP) - energy(k, -2.0 * STEP);
                (8.0 * near - far) / (12.0 * STEP)
            })
            .collect();
        close(&scene.name, &gravity, &slopes, 1e-9);
    }
}

#[test]
fn the_equations_of_motion_hold_with_the_forces_of_gravity() {
    for scene in mechanisms().iter().map(lightened) {
        let mut tree = wandering(&scene, 13);
        let n = tree.velocities().len();
        let effort = Random::new(17).vector(n, n, 2.0);
        let a = tree.forward_dynamics(&effort).expect("accelerations").to_vec();
        let mass = tree.mass_matrix().clone();
        let size = 1.0 + a.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
        close(&scene.name, tree.inverse_dynamics(&a).expect("efforts"), &effort, ROUNDING * size);
        let bias = tree.bias_forces().to_vec();
        let sum: Vec<f64> = (0..n).map(|i| dot(mass.row(i), &a) + bias[i]).collect();
        close(&scene.name, &sum, &effort, ROUNDING * size);
        let all = tree.accelerations().expect("accelerations").to_vec();
        let free = tree.forward_dynamics(&vec![0.0; n]).expect("accelerations");
        close(&scene.name, free, &all, ROUNDING * size);
    }
}

#[test]
fn what_has_no_weight_stays_at_rest() {
    let mut scene = file("double-pendulum");
    scene.bodies.iter_mut().for_each(|body| body.gravity_scale = Some(0.0));
    let mut tree = tree(&scene);
    tree.set(&[0.4, -1.1], &[0.0, 0.0]).expect("a state");
    close("g", tree.gravity_forces(), &[0.0, 0.0], ROUNDING);
    close("a", tree.accelerations().expect("accelerations"), &[0.0, 0.0], ROUNDING);
}
