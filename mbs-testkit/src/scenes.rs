//! Scenes: from text, from the repository, and empty ones to fill.

use crate::repository::{read_in, scene_text};
use mbs_core::Real;
use mbs_core::scene::{Dimension, Scene};
use std::sync::LazyLock;

/// Every planar joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = include_str!("planar-zoo.toml");
/// Every spatial joint kind, guide law and effect, a welded pair, a rod held by balls and a body fixed to the ground.
pub const SPATIAL: &str = include_str!("spatial-zoo.toml");

/// A mass on a bar.
pub static SIMPLE: LazyLock<String> = LazyLock::new(|| scene_text("simple-pendulum"));
/// Two bars in a row.
pub static DOUBLE: LazyLock<String> = LazyLock::new(|| scene_text("double-pendulum"));
/// Three parallel cranks, with singular positions.
pub static TWO_FOUR_BARS: LazyLock<String> = LazyLock::new(|| scene_text("two-four-bars"));
/// Eleven parallel cranks.
pub static N_FOUR_BAR: LazyLock<String> = LazyLock::new(|| scene_text("n-four-bar-10"));
/// A slider-crank.
pub static SLIDER: LazyLock<String> = LazyLock::new(|| scene_text("slider-crank"));
/// A four-bar whose crank is guided: it has no freedom.
pub static GUIDED: LazyLock<String> = LazyLock::new(|| scene_text("guided-four-bar"));
/// Twenty bodies in a row, in space.
pub static CHAIN: LazyLock<String> = LazyLock::new(|| scene_text("spatial-chain-20"));
/// A planar four-bar made of spatial joints: three of its conditions are redundant.
pub static REDUNDANT: LazyLock<String> = LazyLock::new(|| scene_text("spatial-four-bar"));
/// A heavy top.
pub static TOP: LazyLock<String> = LazyLock::new(|| scene_text("spinning-top"));
/// A body that nothing holds.
pub static FREE: LazyLock<String> = LazyLock::new(|| scene_text("free-body"));

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
    read_in(text, "test.toml")
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
    read_in(&scene_text(name), name)
}

/// A scene of one second without bodies.
#[must_use]
pub fn empty(name: &str, dimension: Dimension, gravity: Option<[f64; 3]>) -> Scene<f64> {
    Scene { gravity, ..Scene::empty(name, dimension, 1.0) }
}
