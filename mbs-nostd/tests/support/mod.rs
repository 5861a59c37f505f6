//! Scenes of the repository as trees that stand at their start.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its part")]

use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::start::assemble;
use mbs_recursive::space::Space;
use mbs_recursive::{TreeModel, TreeState};
use mbs_sparse::Multifrontal;

/// A scene file of the repository.
pub fn file(name: &str) -> Scene<f64> {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the scene is there");
    read(&text, name)
}

/// A scene from its text.
pub fn read(text: &str, name: &str) -> Scene<f64> {
    let document =
        mbs_scene::Document::parse(text, name).unwrap_or_else(|e| panic!("{}", e.render()));
    document.scene::<f64>().unwrap_or_else(|e| panic!("{}", e.render()))
}

/// A scene's tree and the state that it starts from.
pub fn start<S: Space<f64>, const D: usize>(
    scene: &Scene<f64>,
) -> (TreeModel<f64, S>, TreeState<f64>) {
    let natural =
        NaturalModel::<f64, D>::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let analyse = mbs_sparse::Options::default();
    let mut solver = Multifrontal::analyse(&natural, analyse);
    let start = assemble(scene, &natural, |p| Multifrontal::analyse(p, analyse), &mut solver)
        .unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let tree = TreeModel::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let state =
        tree.start(scene, &natural, &start.state).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    (tree, state)
}
