//! Trees of scenes at their start state.

#[path = "../../../../lab/src/runner/bench/counted.rs"]
pub(crate) mod counted;

use mbs_core::scene::Scene;
use mbs_recursive::space::Space;
use mbs_recursive::{TreeModel, TreeState};

/// Returns a scene's tree and its start state.
pub(crate) fn start<S: Space<f64>, const D: usize>(
    scene: &Scene<f64>,
) -> (TreeModel<f64, S>, TreeState<f64>) {
    let (natural, start) = mbs_testkit::start::<D>(scene);
    let tree = TreeModel::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let state =
        tree.start(scene, &natural, &start).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    (tree, state)
}
