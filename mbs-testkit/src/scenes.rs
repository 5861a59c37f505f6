//! Scenes for tests: from text, from the repository, and without bodies.

use crate::repository::{read_in, scene_text};
use mbs_core::Real;
use mbs_core::scene::{Dimension, Scene};
use std::sync::LazyLock;

/// A planar scene with every joint kind, guide law and effect, a welded pair and bodies fixed to the ground.
pub const PLANAR: &str = include_str!("planar-zoo.toml");
/// A spatial scene with every joint kind, guide law and effect, a welded pair, a rod between ball joints and a body fixed to the ground.
pub const SPATIAL: &str = include_str!("spatial-zoo.toml");

/// A simple pendulum: a mass on a bar.
pub static SIMPLE: LazyLock<String> = LazyLock::new(|| scene_text("simple-pendulum"));
/// A double pendulum: two bars in series.
pub static DOUBLE: LazyLock<String> = LazyLock::new(|| scene_text("double-pendulum"));
/// Two four-bar linkages: three parallel cranks, with singular positions.
pub static TWO_FOUR_BARS: LazyLock<String> = LazyLock::new(|| scene_text("two-four-bars"));
/// Ten four-bar linkages: eleven parallel cranks.
pub static N_FOUR_BAR: LazyLock<String> = LazyLock::new(|| scene_text("n-four-bar-10"));
/// A slider-crank mechanism of the repository.
pub static SLIDER: LazyLock<String> = LazyLock::new(|| scene_text("slider-crank"));
/// A four-bar linkage with a guided crank, so that no freedom remains.
pub static GUIDED: LazyLock<String> = LazyLock::new(|| scene_text("guided-four-bar"));
/// A spatial chain of twenty bodies.
pub static CHAIN: LazyLock<String> = LazyLock::new(|| scene_text("spatial-chain-20"));
/// A planar four-bar linkage made of spatial joints: three of its constraints are redundant.
pub static REDUNDANT: LazyLock<String> = LazyLock::new(|| scene_text("spatial-four-bar"));
/// A heavy spinning top.
pub static TOP: LazyLock<String> = LazyLock::new(|| scene_text("spinning-top"));
/// A free body without joints.
pub static FREE: LazyLock<String> = LazyLock::new(|| scene_text("free-body"));

/// Reads a scene from its text.
///
/// # Panics
///
/// If the text is not a valid scene, with the fault as message.
#[must_use]
pub fn scene(text: &str) -> Scene<f64> {
    scene_in(text)
}

/// Reads a scene from its text, in numbers of type `T`.
///
/// # Panics
///
/// If the text is not a valid scene, with the fault as message.
#[must_use]
pub fn scene_in<T: Real>(text: &str) -> Scene<T> {
    read_in(text, "test.toml")
}

/// Reads a scene file of the repository.
///
/// # Panics
///
/// If there is no file of this name.
#[must_use]
pub fn file(name: &str) -> Scene<f64> {
    file_in(name)
}

/// Reads a scene file of the repository, in numbers of type `T`.
///
/// # Panics
///
/// If there is no file of this name.
#[must_use]
pub fn file_in<T: Real>(name: &str) -> Scene<T> {
    read_in(&scene_text(name), name)
}

/// Creates a scene of one second without bodies.
#[must_use]
pub fn empty(name: &str, dimension: Dimension, gravity: Option<[f64; 3]>) -> Scene<f64> {
    Scene { gravity, ..Scene::empty(name, dimension, 1.0) }
}

/// Returns the text of a planar four-bar linkage with all bodies along x. `centers` are those of crank, coupler and rocker; `places` are the
/// points of the joints O, A, C and B. O and B are on the ground, C is between coupler and rocker.
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
