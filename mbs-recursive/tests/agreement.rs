//! The recursion against natural coordinates: independent derivations of the same accelerations.

mod support;

use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial};
use support::{Run, common, file, natural, random};

/// Rounding of accelerations of order 10 to 1000 through trees and loops whose conditioning is that of random geometry.
const ROUNDING: f64 = 1e-9;

/// Largest difference of positions, velocities and accelerations, relative to the largest of each.
fn apart<S: Space<f64>, const D: usize>(scene: &Scene<f64>) -> [f64; 3] {
    let (model, state) = natural::<D>(scene);
    let motions = Run::<S>::new::<D>(scene).motions(scene.bodies.len());
    let mut back = state.clone();
    model.write_motions(&motions, &mut back);
    let apart = |x: &[f64], y: &[f64]| {
        let size = x.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
        x.iter().zip(y).fold(0.0_f64, |d, (x, y)| d.max((x - y).abs())) / size
    };
    [apart(&state.q, &back.q), apart(&state.v, &back.v), apart(&state.a, &back.a)]
}

fn check(scene: &Scene<f64>) {
    let apart = match scene.dimension {
        Dimension::Planar => apart::<Planar, 2>(scene),
        Dimension::Spatial => apart::<Spatial, 3>(scene),
    };
    assert!(apart.iter().all(|&d| d < ROUNDING), "{}: {apart:?}", scene.name);
}

/// The same for a state that has moved on from random velocities, against the equations of natural coordinates there.
fn wander<S: Space<f64>, const D: usize>(scene: &Scene<f64>, seed: u64) {
    let mut run = Run::<S>::wandering(scene, seed);
    let motions = run.motions(scene.bodies.len());
    let model = NaturalModel::<f64, D>::new(scene).expect("the scene has a model");
    let mut state = State::at_rest(&model);
    state.t = run.state.t;
    model.write_motions(&motions, &mut state);
    let left = support::imbalance(&model, &state);
    println!("{} {left:?} {}", scene.name, run.model.n_rows());
    assert!(left.iter().all(|&x| x < ROUNDING), "{}: {left:?}", scene.name);
}

#[test]
fn every_scene_has_the_accelerations_of_natural_coordinates() {
    let mut n = 0;
    for entry in std::fs::read_dir("../scenes").expect("the scenes are there") {
        let path = entry.expect("a file").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        check(&file(&name));
        n += 1;
    }
    assert!(n >= 10, "all scenes are read");
}

#[test]
fn every_joint_guide_and_effect_has_the_accelerations_of_natural_coordinates() {
    check(&common::scene(common::PLANAR));
    check(&common::scene(common::SPATIAL));
}

#[test]
fn random_trees_of_mixed_joints_have_the_accelerations_of_natural_coordinates() {
    for seed in 1..=12 {
        let n = 10 + 2 * seed as usize;
        wander::<Spatial, 3>(&random::tree(seed, n, Dimension::Spatial), seed);
        wander::<Planar, 2>(&random::tree(seed, n, Dimension::Planar), seed);
    }
}

#[test]
fn random_closed_loops_have_the_accelerations_of_natural_coordinates() {
    for seed in 1..=12 {
        wander::<Spatial, 3>(&random::closed(seed, 12, 4, Dimension::Spatial), seed);
        wander::<Planar, 2>(&random::closed(seed, 12, 3, Dimension::Planar), seed);
    }
}

#[test]
fn a_loop_given_twice_changes_nothing() {
    for seed in 1..=4 {
        let once = random::closed(seed, 10, 3, Dimension::Spatial);
        let mut twice = once.clone();
        let last = twice.joints[twice.joints.len() - 2].clone();
        twice.joints.push(last);
        let motions =
            |scene: &Scene<f64>| Run::<Spatial>::wandering(scene, seed).motions(scene.bodies.len());
        for (x, y) in motions(&once).iter().zip(&motions(&twice)) {
            assert!((x.acceleration - y.acceleration).amax() < ROUNDING * 100.0, "seed {seed}");
            assert!(
                (x.angular_acceleration - y.angular_acceleration).amax() < ROUNDING * 100.0,
                "seed {seed}"
            );
        }
    }
}
