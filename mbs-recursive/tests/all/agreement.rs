//! Accelerations of the recursion compared with those of natural coordinates. The two are derived independently.

use crate::support::{Run, imbalance, random};
use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::space::Space;
use mbs_recursive::{Planar, Spatial, TreeModel, Workspace};
use mbs_testkit::{file, start};

/// Largest residual of the equations, relative to their terms [-]: a few hundred rounding errors.
const ROUNDING: f64 = 1e-12;

/// Largest relative difference of two evaluations of accelerations [-]. It allows for the conditioning of loops with random geometry.
const TWICE: f64 = 1e-8;

/// Returns the largest differences of positions, velocities and accelerations between tree and natural coordinates, each relative to the
/// largest value.
fn apart<S: Space<f64>, const D: usize>(scene: &Scene<f64>) -> [f64; 3] {
    let (model, state) = start::<D>(scene);
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

/// Starts a scene with random velocities and advances it. Then checks the accelerations of the state by the equations of natural
/// coordinates.
fn wander<S: Space<f64>, const D: usize>(scene: &Scene<f64>, seed: u64) {
    let mut run = Run::<S>::wandering(scene, seed);
    let motions = run.motions(scene.bodies.len());
    let model = NaturalModel::<f64, D>::new(scene).expect("the scene has a model");
    let mut state = State::at_rest(&model);
    state.t = run.state.t;
    model.write_motions(&motions, &mut state);
    let left = imbalance(&model, &state);
    assert!(left.iter().all(|&x| x < ROUNDING), "{}: {left:?}", scene.name);
}

#[test]
fn every_scene_has_the_accelerations_of_natural_coordinates() {
    let mut n = 0;
    for entry in std::fs::read_dir("../scenes").expect("the scenes are there") {
        let path = entry.expect("a file").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        check(&file(&name));
        n += 1;
    }
    assert!(n >= 10, "all scenes are read");
}

#[test]
fn every_joint_guide_and_effect_has_the_accelerations_of_natural_coordinates() {
    check(&mbs_testkit::scene(mbs_testkit::PLANAR));
    check(&mbs_testkit::scene(mbs_testkit::SPATIAL));
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
    for seed in 1..=6 {
        let once = random::closed(seed, 10, 3, Dimension::Spatial);
        let mut twice = once.clone();
        let last = twice.joints[twice.joints.len() - 2].clone();
        twice.joints.push(last);
        let run = Run::<Spatial>::wandering(&once, seed);
        let mut other = Run::<Spatial>::wandering(&twice, seed);
        assert!(other.model.n_rows() > run.model.n_rows());
        other.state.z.copy_from_slice(&run.state.z);
        other.state.v.copy_from_slice(&run.state.v);
        other.accelerate();
        mbs_testkit::close(&once.name, &other.state.a, &run.state.a, TWICE);
        // The force is divided between the two equal loops, so that the force of each row is smaller.
        let rank = |run: &mut Run<Spatial>| run.model.rank(&run.state, &mut run.workspace);
        let mut run = run;
        assert_eq!(rank(&mut run), rank(&mut other), "{}", once.name);
    }
}

#[test]
fn which_joint_is_cut_does_not_change_the_motion() {
    for seed in 1..=6 {
        let scene = random::closed(seed, 10, 3, Dimension::Planar);
        let mut run = Run::<Planar>::wandering(&scene, seed);
        let motions = run.motions(scene.bodies.len());
        let mut turned = scene.clone();
        turned.joints.reverse();
        let model = TreeModel::<f64, Planar>::new(&turned).expect("the scene has a tree");
        let names = |model: &TreeModel<f64, Planar>, scene: &Scene<f64>| {
            model.cut_joints().map(|j| scene.joints[j].points).collect::<Vec<_>>()
        };
        if seed == 1 {
            assert_ne!(names(&run.model, &scene), names(&model, &turned), "another joint is cut");
        }
        let state = model.start_from(&turned, run.state.t, &motions).expect("the loops close");
        let mut other = vec![motions[0]; motions.len()];
        model.write_motions(&state, &mut Workspace::new(&model), &mut other);
        let size = motions.iter().fold(1.0_f64, |s, m| s.max(m.acceleration.amax()));
        for (x, y) in motions.iter().zip(&other) {
            let apart = (x.point(&y.origin)[2] - y.acceleration).amax();
            assert!(apart < TWICE * size, "seed {seed}: {apart}");
        }
    }
}
