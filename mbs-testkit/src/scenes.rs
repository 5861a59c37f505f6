//! Scenes: from text, from the repository, and empty ones to fill.

use mbs_core::Real;
use mbs_core::scene::{Dimension, Scene};
use mbs_scene::SceneFile;
use std::sync::LazyLock;

/// Every planar joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = include_str!("planar-zoo.toml");
/// Every spatial joint kind, guide law and effect, a welded pair, a rod held by balls and a body fixed to the ground.
pub const SPATIAL: &str = include_str!("spatial-zoo.toml");

/// A mass on a bar.
pub static SIMPLE: LazyLock<String> = LazyLock::new(|| text("simple-pendulum"));
/// Two bars in a row.
pub static DOUBLE: LazyLock<String> = LazyLock::new(|| text("double-pendulum"));
/// Three parallel cranks, with singular positions.
pub static TWO_FOUR_BARS: LazyLock<String> = LazyLock::new(|| text("two-four-bars"));
/// Eleven parallel cranks.
pub static N_FOUR_BAR: LazyLock<String> = LazyLock::new(|| text("n-four-bar-10"));
/// A slider-crank.
pub static SLIDER: LazyLock<String> = LazyLock::new(|| text("slider-crank"));
/// A four-bar whose crank is guided: it has no freedom.
pub static GUIDED: LazyLock<String> = LazyLock::new(|| text("guided-four-bar"));
/// Twenty bodies in a row, in space.
pub static CHAIN: LazyLock<String> = LazyLock::new(|| text("spatial-chain-20"));
/// A planar four-bar made of spatial joints: three of its conditions are redundant.
pub static REDUNDANT: LazyLock<String> = LazyLock::new(|| text("spatial-four-bar"));
/// A heavy top.
pub static TOP: LazyLock<String> = LazyLock::new(|| text("spinning-top"));
/// A body that nothing holds.
pub static FREE: LazyLock<String> = LazyLock::new(|| text("free-body"));

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
    let document = SceneFile::parse(text, "test.toml").unwrap_or_else(|e| panic!("{}", e.render()));
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
    scene_in(&text(name))
}

/// The text of a scene file of the repository, read when it is asked for: a package holds no file from outside its folder.
fn text(name: &str) -> String {
    let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// A scene of one second without bodies.
#[must_use]
pub fn empty(name: &str, dimension: Dimension, gravity: Option<[f64; 3]>) -> Scene<f64> {
    Scene { gravity, ..Scene::empty(name, dimension, 1.0) }
}
