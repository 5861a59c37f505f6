//! Inverse dynamics, mass matrix and reactions compared with forward dynamics and with natural coordinates.

use crate::support::{Run, random};
use mbs_core::algebra::Vector;
use mbs_core::outputs::Reactions;
use mbs_core::scene::{Dimension, Scene};
use mbs_recursive::own::OwnFreedoms;
use mbs_recursive::space::Space;
use mbs_recursive::{EffortTerms, Planar, Spatial};
use mbs_testkit::{file, start};

/// Largest relative error by rounding in trees of 20 bodies with random geometry [-].
const ROUNDING: f64 = 1e-10;

fn check_tree<S: Space<f64>>(scene: &Scene<f64>, seed: u64) {
    let mut run = Run::<S>::wandering(scene, seed);
    let n = run.model.n_freedoms();
    let mut efforts = vec![f64::NAN; n];
    let mut inverse = |run: &mut Run<S>| {
        let terms = EffortTerms::WithEffects;
        run.model.write_efforts((&run.state, terms), &mut run.workspace, &mut efforts);
        efforts.clone()
    };
    let free = inverse(&mut run);
    let a = run.state.a.clone();
    // τ(a) = M a + bias. τ(0) is the bias, and τ of the free motion is zero.
    run.state.a.fill(0.0);
    let bias = inverse(&mut run);
    mbs_testkit::close("efforts of free motion", &free, &vec![0.0; n], ROUNDING * largest(&bias));
    let mut mass = vec![f64::NAN; n * n];
    let mut freedoms = OwnFreedoms::of_tree(&run.model);
    freedoms.write_mass_matrix(&run.model, &run.state, &mut run.workspace, &mut mass);
    let product: Vec<f64> =
        (0..n).map(|i| mbs_testkit::dot(&mass[i * n..(i + 1) * n], &a) + bias[i]).collect();
    mbs_testkit::close("M a + bias", &product, &vec![0.0; n], ROUNDING * largest(&bias));
    // A second acceleration tests the product M a in another direction.
    let other = mbs_testkit::Random(seed + 99).vector(n, n, 3.0);
    run.state.a.copy_from_slice(&other);
    let efforts = inverse(&mut run);
    let product: Vec<f64> =
        (0..n).map(|i| mbs_testkit::dot(&mass[i * n..(i + 1) * n], &other) + bias[i]).collect();
    mbs_testkit::close("M x + bias", &product, &efforts, ROUNDING);
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(1.0_f64, |s, x| s.max(x.abs()))
}

#[test]
fn inverse_dynamics_and_mass_matrix_return_what_forward_dynamics_took() {
    for seed in 1..=8 {
        check_tree::<Spatial>(&random::tree(seed, 20, Dimension::Spatial), seed);
        check_tree::<Planar>(&random::tree(seed, 20, Dimension::Planar), seed);
    }
}

/// Compares the reactions of a tree at the start with those of natural coordinates, for each joint whose reaction is unique. Returns the
/// number of comparisons.
fn reactions<S: Space<f64>, const D: usize>(scene: &Scene<f64>) -> usize {
    let (model, state) = start::<D>(scene);
    let mut reference = Reactions::new(scene, &model).expect("reactions of the scene");
    reference.update(&state);
    let mut run = Run::<S>::new::<D>(scene);
    let mut found = vec![[Vector::<f64, 3>::zeros(); 2]; scene.joints.len()];
    run.model.reactions(&run.state, &mut run.workspace, &mut found);
    let mut n = 0;
    for (j, [force, moment]) in found.iter().enumerate() {
        if !reference.is_unique(j) || scene.joints[j].kind == mbs_core::scene::JointKind::Weld {
            continue;
        }
        let r = reference.reaction(j);
        let (f, m) = if D == 2 {
            ([r[0], r[1], 0.0], [0.0, 0.0, r[2]])
        } else {
            ([r[0], r[1], r[2]], [r[3], r[4], r[5]])
        };
        let name = &scene.joints[j].name;
        mbs_testkit::close(name, force.as_slice(), &f, 1e-8);
        mbs_testkit::close(name, moment.as_slice(), &m, 1e-8);
        n += 1;
    }
    n
}

#[test]
fn reactions_are_those_of_natural_coordinates_where_they_are_unique() {
    let planar = ["double-pendulum", "four-bar", "slider-crank", "guided-four-bar", "andrews"];
    for name in planar {
        assert!(reactions::<Planar, 2>(&file(name)) > 0, "{name}");
    }
    for name in ["spinning-top", "spatial-chain-20", "rssr", "tree-30"] {
        assert!(reactions::<Spatial, 3>(&file(name)) > 0, "{name}");
    }
    assert!(reactions::<Planar, 2>(&mbs_testkit::scene(mbs_testkit::PLANAR)) > 0);
    assert!(reactions::<Spatial, 3>(&mbs_testkit::scene(mbs_testkit::SPATIAL)) > 0);
}
