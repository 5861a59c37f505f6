//! Parts that the families of scenes share: a scene that grows, its numbers, and the comment at the head of its text.

use mbs_core::scene::{Dimension, Number, Output, Scene, SolverTable, Vector3};

/// An empty scene with gravity down; duration [s], steps of 1 ms.
pub(super) fn scene(name: &str, dimension: Dimension, duration: f64) -> Scene<Number> {
    let gravity: Vector3 = match dimension {
        Dimension::Planar => [0.0, -9.81].into(),
        Dimension::Spatial => [0.0, 0.0, -9.81].into(),
    };
    Scene {
        gravity: Some(gravity.0),
        solver: SolverTable { step: Some(1e-3.into()), ..SolverTable::default() },
        ..Scene::empty(name, dimension, duration.into())
    }
}

/// The position of a body's point, as an output.
pub(super) fn position(name: &str, body: usize, at: impl Into<Vector3>) -> Output<Number> {
    Output::position(mbs_core::scene::BodyId::Body(body), at).named(name)
}

/// The comment that says what the scene is and which command made it, then its tables.
pub(super) fn headed(comment: &str, command: &str, tables: &str) -> String {
    let mut text = String::new();
    let mut line = |line: &str| {
        text.push_str(format!("# {line}").trim_end());
        text.push('\n');
    };
    comment.lines().for_each(&mut line);
    line("");
    // A name of a file may hold anything; a comment ends with its line.
    let command: String = command.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    line(&format!("Made by `{command}`."));
    format!("{text}\n{tables}")
}

/// A scene as text under its comment.
pub(super) fn text(comment: &str, command: &str, scene: &Scene<Number>) -> String {
    // What is generated has neither code nor references to nothing.
    headed(comment, command, &crate::to_toml(scene).unwrap_or_default())
}

/// A number of 15 digits: multiples of decimal numbers stay as short as they are meant.
pub fn number(x: f64) -> Number {
    let rounded: f64 = format!("{x:.14e}").parse().unwrap_or(x);
    // No minus before a zero.
    (rounded + 0.0).into()
}

/// Vector of numbers of 15 digits.
pub(super) fn vector<const N: usize>(x: [f64; N]) -> [Number; N] {
    x.map(number)
}

/// Width of a bar, relative to its length [-].
const SLENDER: f64 = 0.2;

/// Inertia of a uniform square bar of mass m [kg] from end to end [m], about its centre, as scene files have it. It is
/// It 1 + (Ia - It) u u^T, u along it.
pub(super) fn bar(mass: f64, d: [f64; 3]) -> [Number; 6] {
    let square: f64 = d.iter().map(|x| x * x).sum();
    let width = SLENDER * SLENDER * square;
    let (along, across) = (mass * width / 6.0, mass * (square + width) / 12.0);
    let entry = |i: usize, j: usize| {
        let dyad = (along - across) * d[i] * d[j] / square;
        if i == j { across + dyad } else { dyad }
    };
    vector([entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)])
}
