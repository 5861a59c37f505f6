//! A scene through the crates, beside the judge: this folder alone knows them.

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

/// Divisor of the step with which a run that stops is tried again. Chosen, not tuned.
const QUARTER: u32 = 4;
/// Divisor of the given step for short ones. Chosen, not tuned.
const SHORT: u32 = 16;
/// Ratio of an error with short steps to that with the given ones, up to which it is the rule's [-]: 1/16 by order 1, 1/4 after a stop.
const GONE: f64 = 0.4;

/// Holds a method against the judge. A run that stops on its way is tried by quarter steps. What is off is looked at once more with short
/// steps. Two steps may hide the error of a rule across a kink of a law, which goes with the step. What is wrong stays.
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

/// Verdict by steps over `share` and half of them.
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
