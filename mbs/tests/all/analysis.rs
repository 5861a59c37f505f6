//! Start of a run from an equilibrium.

use crate::common::scene;
use mbs::core::model::Model;
use mbs::core::natural::NaturalModel;
use mbs::core::start::assemble;
use mbs::sparse::{Multifrontal, Options};

#[test]
fn a_start_from_equilibrium_rests_or_moves_as_the_scene_says() {
    for name in ["double-pendulum", "spatial-four-bar", "tree-30"] {
        let mut scene = scene(name);
        scene.initials.clear();
        match scene.dimension {
            mbs::core::scene::Dimension::Planar => rests::<2>(&scene),
            mbs::core::scene::Dimension::Spatial => rests::<3>(&scene),
        }
    }
}

/// Without initial velocities nothing moves, and accelerations are rounding.
fn rests<const D: usize>(scene: &mbs::core::scene::Scene<f64>) {
    let model = NaturalModel::<f64, D>::new(scene).expect("it has a model");
    let analyse = Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let mut start = start.expect("it assembles");
    let found = mbs::equilibrium_start(scene, &model, mbs::Search::Down, &mut solver, &mut start)
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    assert!(found.relative < 1e-12, "{}: {found:?}", scene.name);
    assert!(start.state.v.iter().all(|v| *v == 0.0), "{}", scene.name);
    // the limit is the rounding of forces divided by the smallest inertia of the tree, about 1e-3 kg m^2
    let fastest = start.state.a.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    assert!(fastest < 1e-8, "{}: {fastest}", scene.name);
    assert!(start.residual.iter().all(|r| *r < 1e-9), "{:?}", start.residual);
    assert!(model.kinetic_energy(&start.state.v) == 0.0);
}

#[test]
fn a_start_from_equilibrium_takes_the_initial_velocities() {
    let mut scene = scene("simple-pendulum");
    scene.initials = vec![mbs::core::scene::InitialCondition {
        target: mbs::core::scene::InitialTarget::Joint {
            joint: mbs::core::scene::JointId::new(0),
            value: Some(vec![0.4]),
            rate: Some(vec![2.0]),
        },
    }];
    let model = NaturalModel::<f64, 2>::new(&scene).expect("it has a model");
    let analyse = Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(&scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let mut start = start.expect("it assembles");
    mbs::equilibrium_start(&scene, &model, mbs::Search::Down, &mut solver, &mut start)
        .expect("it hangs");
    // the bob hangs straight down and turns at 2 rad/s: the centripetal acceleration is 4 m/s^2 at 1 m
    let tip = model.point(mbs::core::scene::BodyId::Body(0), [-1.0, 0.0, 0.0]);
    let (x, v, a) = (tip.value(&start.state.q), tip.rate(&start.state.v), tip.rate(&start.state.a));
    assert!(x[0].abs() < 1e-10 && (x[1] + 1.0).abs() < 1e-10, "{x:?}");
    assert!((v[0] - 2.0).abs() < 1e-10 && v[1].abs() < 1e-9, "{v:?}");
    assert!((a[1] - 4.0).abs() < 1e-8 && a[0].abs() < 1e-8, "{a:?}");
}
