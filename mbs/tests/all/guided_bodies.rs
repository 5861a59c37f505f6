//! Joints with guides for all coordinates, and guided bodies, against kinematics and balances by hand, in every formulation.

mod hexapod;
mod kinematics;
mod mechanisms;
mod platform;

use crate::common::oracle::{self, Rows, WAYS, Way};
use kinematics::{Motion, Sine};
use std::fmt::Write as _;

fn head(dimension: usize, gravity: &str) -> String {
    format!(
        "[scene]\nname = \"g\"\ndimension = {dimension}\nduration = 10.0\ngravity = {gravity}\n"
    )
}

/// Texts of a guide's signals a, b, c and so on, and of the list of their names.
fn signals(sines: &[Sine]) -> (String, String) {
    let (mut text, mut names) = (String::new(), Vec::new());
    for (sine, name) in sines.iter().zip('a'..) {
        let [amplitude, frequency, phase] = sine.0;
        write!(
            text,
            "[[signal]]\nname = \"{name}\"\nkind = \"sine\"\namplitude = {amplitude:?}\nfrequency = {frequency:?}\nphase = {phase:?}\n"
        )
        .expect("a string takes all");
        names.push(format!("\"{name}\""));
    }
    (text, format!("[{}]", names.join(", ")))
}

fn output(of: &str, rest: &str, quantity: &str) -> String {
    let name = format!("{of}-{quantity}-{rest}").replace([' ', '=', '"'], "");
    format!("[[output]]\nname = \"{name}\"\n{of}\nquantity = \"{quantity}\"\n{rest}\n")
}

/// Largest difference of numbers from the expected ones, divided by one plus their size; NaN if a number is NaN.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let size = 1.0 + expected.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    let pairs = found.iter().zip(expected);
    pairs.fold(0.0, |a, (x, y)| crate::common::worst(a, (x - y).abs() / size))
}

/// Signals of three translations, and of a rotation vector that reaches three revolutions [m, Hz, rad].
const SIX: [Sine; 6] = [
    Sine([0.08, 0.7, 0.4]),
    Sine([0.06, 0.9, -0.2]),
    Sine([0.05, 1.1, 0.0]),
    Sine([2.2, 0.8, 0.1]),
    Sine([-5.1, 1.0, 0.3]),
    Sine([19.0, 0.3, 0.0]),
];

/// Motion without translation, whose rotation vector is the last three signals of [`SIX`].
fn turning() -> Motion {
    Motion { translation: [Sine([0.0; 3]); 3], rotation: [SIX[3], SIX[4], SIX[5]] }
}
