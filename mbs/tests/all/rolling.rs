//! Rolling without slip, and blades, against closed forms and independent equations of motion, in every formulation that supports them.

mod closed_forms;
mod contacts;
mod dependent;
mod refusals;

use crate::common::oracle::{self, Rows, Way, last};

/// Formulations with velocity constraints, by the trapezoidal rule.
const WAYS: [&str; 4] = ["index-3", "index-1", "classical", "recursive"];
/// Explicit integrators of high order.
const EXPLICIT: [&str; 2] = ["rk853", "rk4"];

fn run(text: &str, way: Way, step: f64, duration: f64) -> Rows {
    oracle::run(text, way, (step, duration))
}

/// Components of the last row.
fn end(text: &str, way: Way, step: f64, duration: f64) -> Vec<f64> {
    last(&run(text, way, step, duration)).to_vec()
}

/// Largest difference of numbers from the expected ones.
fn apart(found: &[f64], right: &[f64]) -> f64 {
    assert_eq!(found.len(), right.len());
    found.iter().zip(right).fold(0.0, |a, (x, y)| a.max((x - y).abs()))
}

/// Asserts the values at the end. Methods of high order have an error of `digits`. The trapezoidal rule has an error of at most `error` at
/// `step`, which falls with the square of the step.
fn check(text: &str, duration: f64, (step, error): (f64, f64), (right, digits): (&[f64], f64)) {
    for method in EXPLICIT {
        let found = end(text, Way("recursive", method), step, duration);
        assert!(apart(&found, right) < digits, "{method}: {found:?}, {right:?}");
    }
    for formulation in WAYS {
        let way = Way(formulation, "trapezoidal");
        let [coarse, fine] =
            [1.0, 0.5].map(|part| apart(&end(text, way, step * part, duration), right));
        println!("{formulation}: {coarse:.2e}, {fine:.2e}");
        assert!(coarse < error, "{formulation}: {coarse:e}");
        let ratio = coarse / fine;
        assert!((3.6..4.4).contains(&ratio), "{formulation}: {coarse:e} over {fine:e}: {ratio}");
    }
}
