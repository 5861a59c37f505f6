//! Functions that several families of scenes use: an empty scene, numbers and vectors, and the comment at the head of a text.

use mbs_core::scene::{Dimension, Number, Output, Scene, SolverTable, Vector3};

/// An empty scene with gravity downwards, this duration [s] and steps of 1 ms.
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

/// An output of the position of a point of a body.
pub(super) fn position(name: &str, body: usize, at: impl Into<Vector3>) -> Output<Number> {
    Output::position(mbs_core::scene::BodyId::Body(body), at).named(name)
}

/// Joins the comment, a line that names the command, and the tables.
pub(super) fn headed(comment: &str, command: &str, tables: &str) -> String {
    let mut text = String::new();
    let mut line = |line: &str| {
        text.push_str(format!("# {line}").trim_end());
        text.push('\n');
    };
    comment.lines().for_each(&mut line);
    line("");
    // A file name in the command may have control characters, but a comment must stay on its line.
    let command: String = command.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    line(&format!("Made by `{command}`."));
    format!("{text}\n{tables}")
}

/// The text of a scene, below its comment.
pub(super) fn text(comment: &str, command: &str, scene: &Scene<Number>) -> String {
    // A generated scene has no user-defined code and no unknown references, so writing it does not fail.
    headed(comment, command, &crate::to_toml(scene).unwrap_or_default())
}

/// A number rounded to 15 digits, so that multiples of short decimals stay short.
pub fn number(x: f64) -> Number {
    let rounded: f64 = format!("{x:.14e}").parse().unwrap_or(x);
    // The sum turns minus zero into zero.
    (rounded + 0.0).into()
}

/// A vector of numbers rounded to 15 digits.
pub(super) fn vector<const N: usize>(x: [f64; N]) -> [Number; N] {
    x.map(number)
}

/// Width of a bar relative to its length [-].
const SLENDER: f64 = 0.2;

/// Inertia of a uniform bar of square section about its centre [kg m²], in the order of scene files. `d` is the vector from end to end [m].
/// The matrix is It 1 + (Ia - It) u u^T. Here u is the unit vector along the bar, Ia the moment about it, and It the moment about any axis
/// across it.
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
