//! The recursion against natural coordinates: an independent derivation of the same accelerations.

use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Scene};
use mbs_core::start::assemble;
use mbs_recursive::space::Space;
use mbs_recursive::{Options, Planar, Spatial, TreeModel, TreeState, Workspace};
use mbs_sparse::Multifrontal;
use nalgebra::Vector3;

#[path = "../../mbs-core/tests/common/mod.rs"]
mod common;

fn natural<const D: usize>(scene: &Scene<f64>) -> (NaturalModel<f64, D>, State<f64>) {
    let model = NaturalModel::<f64, D>::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let analyse = mbs_sparse::Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    (model, start.state)
}

/// Largest difference of positions, velocities and accelerations, relative to the largest of each.
fn compare<S: Space<f64>, const D: usize>(scene: &Scene<f64>) -> [f64; 3] {
    let (model, state) = natural::<D>(scene);
    let tree = TreeModel::<f64, S>::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let start =
        tree.start(scene, &model, &state).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let mut motions = vec![RigidMotion::at_rest(Vector3::zeros()); scene.bodies.len()];
    tree.write_motions(&start, &mut Workspace::new(&tree), &mut motions);
    let mut back = state.clone();
    model.write_motions(&motions, &mut back);
    let apart = |x: &[f64], y: &[f64]| {
        let size = x.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
        x.iter().zip(y).fold(0.0_f64, |d, (x, y)| d.max((x - y).abs())) / size
    };
    [apart(&state.q, &back.q), apart(&state.v, &back.v), apart(&state.a, &back.a)]
}

fn check(text: &str) {
    let scene = common::scene(text);
    let apart = match scene.dimension {
        Dimension::Planar => compare::<Planar, 2>(&scene),
        Dimension::Spatial => compare::<Spatial, 3>(&scene),
    };
    println!("{}: {apart:?}", scene.name);
}

#[test]
fn zoo() {
    for file in std::fs::read_dir("../scenes").unwrap() {
        let path = file.unwrap().path();
        println!("{}", path.display());
        check(&std::fs::read_to_string(path).unwrap());
    }
    check(common::PLANAR);
    check(common::SPATIAL);
}
