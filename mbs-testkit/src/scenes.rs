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

/// The text of a planar four-bar that is drawn along x: its crank, coupler and rocker with these centres, its joints O, A, C and B at these
/// places. O and B are on the ground, C is between coupler and rocker.
pub fn flat_four_bar(head: &str, centers: [f64; 3], places: [f64; 4]) -> String {
    let bars = ["crank", "coupler", "rocker"].into_iter().zip(centers).map(|(name, center)| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{center}, 0.0]\ninertia = 0.1\n"
        )
    });
    let ends = [
        ("O", ["ground", "crank"]),
        ("A", ["crank", "coupler"]),
        ("C", ["coupler", "rocker"]),
        ("B", ["ground", "rocker"]),
    ];
    let joints = ends.into_iter().zip(places).map(|((name, bodies), at)| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"revolute\"\nbodies = {bodies:?}\nat = [{at}, 0.0]\n"
        )
    });
    let parts: Vec<String> = bars.chain(joints).collect();
    format!("[scene]\ndimension = 2\nduration = 0.1\n{head}{}", parts.concat())
}
