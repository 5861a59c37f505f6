//! Rolling without slipping, and blades, against closed forms and equations of motion apart, in every formulation that has them.

mod closed_forms;
mod contacts;
mod dependent;
mod refusals;

use crate::common::oracle::{self, Rows, Way, last};

/// The formulations that have rows of velocities, with the trapezoidal rule.
const WAYS: [&str; 4] = ["index-3", "index-1", "classical", "recursive"];
/// Methods of high order.
const EXPLICIT: [&str; 2] = ["rk853", "rk4"];

fn run(text: &str, way: Way, step: f64, duration: f64) -> Rows {
    oracle::run(text, way, (step, duration))
}

/// The components at the end.
fn end(text: &str, way: Way, step: f64, duration: f64) -> Vec<f64> {
    last(&run(text, way, step, duration)).to_vec()
}

/// The largest difference of numbers from those that they should be.
fn apart(found: &[f64], right: &[f64]) -> f64 {
    assert_eq!(found.len(), right.len());
    found.iter().zip(right).fold(0.0, |a, (x, y)| a.max((x - y).abs()))
}

/// Ends at the right values: methods of high order to `digits`, the trapezoidal rule with an error that falls with the square of the step
/// and is at most `error` at it.
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
