//! Comparison of the crates with the judge on a scene. Only this folder uses the crates.

pub mod compare;
pub mod oracle;
mod product;
pub mod seeds;

use compare::compare;
pub use compare::{Part, parts};
use product::is_steered;
pub use product::{
    ERROR_FACTOR, Judged, ROUNDING, Rows, Verdict, Way, document, judge, product, rows,
};

/// Divisor of the step for a run that stopped and is tried again. Chosen, not tuned.
const QUARTER: u32 = 4;
/// Divisor of the given step for the run with short steps. Chosen, not tuned.
const SHORT: u32 = 16;
/// Largest ratio of the error with short steps to that with given steps at which the error is one of the integrator [-]. An integrator of
/// order 1 reduces it to 1/16, and to 1/4 after a stop.
const GONE: f64 = 0.4;

/// Compares a method with the judge. A run that stops on its way is tried again with quarter steps. A run that differs is tried again with
/// short steps, since two steps may hide an integrator's error across a kink of a law. This error decreases with the step; an error of the
/// equations remains.
#[must_use]
pub fn trial(
    judged: &Judged,
    product: &mbs::Mechanism,
    method: Way,
    step: f64,
    steps: u32,
) -> Verdict {
    let by = |share| by_two(judged, product, method, (step, steps), share);
    let first = match by(1) {
        Verdict::Stops { code, .. } if code != "refused" => by(QUARTER),
        verdict => verdict,
    };
    let Verdict::Differs { start: false, off, size, .. } = first else { return first };
    match by(SHORT) {
        Verdict::Differs { start: false, off: then, size: of, .. }
            if then * size < GONE * off * of =>
        {
            Verdict::Agrees
        }
        Verdict::Differs { .. } => first,
        other => other,
    }
}

/// Verdict by two runs: with the step divided by `share`, and with half of that step.
fn by_two(
    judged: &Judged,
    product: &mbs::Mechanism,
    method: Way,
    step: (f64, u32),
    share: u32,
) -> Verdict {
    let by = |share| rows(product, method, step, share);
    match by(share).and_then(|coarse| Ok((coarse, by(2 * share)?))) {
        Ok((coarse, fine)) if is_steered(method[0]) => {
            let ends: Rows =
                judged.rows.first().into_iter().chain(judged.rows.last()).cloned().collect();
            compare(judged, &ends, &coarse, &fine)
        }
        Ok((coarse, fine)) => compare(judged, &judged.rows, &coarse, &fine),
        Err(verdict) => verdict,
    }
}
