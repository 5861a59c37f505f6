//! Scenes: from text, from the repository, and empty ones to fill.

use mbs_core::Real;
use mbs_core::scene::{Dimension, Scene, SolverChoice};
use mbs_scene::Document;

/// Every planar joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = include_str!("planar-zoo.toml");
/// Every spatial joint kind, guide law and effect, a welded pair, a rod held by balls and a body fixed to the ground.
pub const SPATIAL: &str = include_str!("spatial-zoo.toml");

/// A mass on a bar.
pub const SIMPLE: &str = include_str!("../../scenes/simple-pendulum.toml");
/// Two bars in a row.
pub const DOUBLE: &str = include_str!("../../scenes/double-pendulum.toml");
/// Three parallel cranks, with singular positions.
pub const TWO_FOUR_BARS: &str = include_str!("../../scenes/two-four-bars.toml");
/// Eleven parallel cranks.
pub const N_FOUR_BAR: &str = include_str!("../../scenes/n-four-bar-10.toml");
/// A slider-crank.
pub const SLIDER: &str = include_str!("../../scenes/slider-crank.toml");
/// A four-bar whose crank is guided: it has no freedom.
pub const GUIDED: &str = include_str!("../../scenes/guided-four-bar.toml");
/// Twenty bodies in a row, in space.
pub const CHAIN: &str = include_str!("../../scenes/spatial-chain-20.toml");
/// A planar four-bar made of spatial joints: three of its conditions are redundant.
pub const REDUNDANT: &str = include_str!("../../scenes/spatial-four-bar.toml");
/// A heavy top.
pub const TOP: &str = include_str!("../../scenes/spinning-top.toml");
/// A body that nothing holds.
pub const FREE: &str = include_str!("../../scenes/free-body.toml");

/// The scene of a text.
///
/// # Panics
///
/// With the fault of a text that is no scene.
#[must_use]
pub fn scene(text: &str) -> Scene<f64> {
    scene_in(text)
}

/// The scene of a text, in numbers of a kind.
///
/// # Panics
///
/// With the fault of a text that is no scene.
#[must_use]
pub fn scene_in<T: Real>(text: &str) -> Scene<T> {
    let document = Document::parse(text, "test.toml").unwrap_or_else(|e| panic!("{}", e.render()));
    document.scene().unwrap_or_else(|e| panic!("{}", e.render()))
}

/// A scene file of the repository.
///
/// # Panics
///
/// Where there is none of this name.
#[must_use]
pub fn file(name: &str) -> Scene<f64> {
    file_in(name)
}

/// A scene file of the repository, in numbers of a kind.
///
/// # Panics
///
/// Where there is none of this name.
#[must_use]
pub fn file_in<T: Real>(name: &str) -> Scene<T> {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    scene_in(&std::fs::read_to_string(path).expect("the scene is in the repository"))
}

/// A scene of one second without bodies.
#[must_use]
pub fn empty(name: &str, dimension: Dimension, gravity: Option<[f64; 3]>) -> Scene<f64> {
    Scene {
        name: name.to_owned(),
        dimension,
        gravity,
        duration: 1.0,
        bodies: Vec::new(),
        joints: Vec::new(),
        initials: Vec::new(),
        guides: Vec::new(),
        effects: Vec::new(),
        road: Default::default(),
        start: Default::default(),
        outputs: Vec::new(),
        solver: SolverChoice::default(),
    }
}
