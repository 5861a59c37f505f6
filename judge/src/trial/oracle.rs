//! Test by enumeration: every case of joints and effects, by every formulation with every integrator.

use super::{Judged, Verdict, Way, compare, judge, product, rows, trial};
use crate::random::{Case, STEPS};
use std::collections::BTreeMap;
use std::num::NonZero;
use std::panic::resume_unwind;
use std::thread;

/// Results of the enumeration, counted.
#[derive(Debug, Default)]
pub struct Tally {
    /// Combinations of case and method that run and agree.
    pub agree: usize,
    /// Combinations left out, by the reason that the command gives.
    pub left_out: BTreeMap<String, usize>,
    /// Combinations whose results are wrong.
    pub wrong: Vec<String>,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.agree += other.agree;
        self.wrong.extend(other.wrong);
        for (reason, n) in other.left_out {
            *self.left_out.entry(reason).or_default() += n;
        }
    }
}

/// Formulations with their integrators. Other pairs are refused as settings for every scene.
pub fn methods() -> Vec<[&'static str; 2]> {
    let formulations = mbs::FORMULATIONS.iter().filter(|f| **f != "auto");
    formulations.flat_map(|f| mbs::INTEGRATORS.map(|i| [*f, i])).collect()
}

/// Runs all cases on all cores. Returns the results in the order of the cases.
#[must_use]
pub fn all(cases: &[Case]) -> Tally {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let try_part = |part: &[Case]| {
        let mut tally = Tally::default();
        part.iter().for_each(|one| case(one, &mut tally));
        tally
    };
    thread::scope(|scope| {
        let parts = cases.chunks(cases.len().div_ceil(threads).max(1));
        let running: Vec<_> = parts.map(|part| scope.spawn(move || try_part(part))).collect();
        let mut all = Tally::default();
        for part in running {
            all.add(part.join().unwrap_or_else(|e| resume_unwind(e)));
        }
        all
    })
}

/// Tries one case in every method.
fn case(case: &Case, tally: &mut Tally) {
    let judged = match judge(&case.text, case.step, STEPS) {
        Ok(judged) => judged,
        Err(why) => return tally.wrong.push(format!("{}: {why}", case.name)),
    };
    let product = match product(&case.text) {
        Ok(product) => product,
        Err(why) => return tally.wrong.push(format!("{}: {why}", case.name)),
    };
    for method in methods() {
        match briefly(&judged, &product, method, case.step, STEPS) {
            Verdict::Agrees => tally.agree += 1,
            Verdict::Stops { code, message, .. } if code == "refused" => {
                *tally.left_out.entry(reason(&message)).or_default() += 1;
            }
            other => tally.wrong.push(format!("{}: {}: {other:?}", case.name, method.join(" "))),
        }
    }
}

/// Verdict by one run with step h if it agrees with the judge to machine precision. Otherwise the verdict of the full trial.
fn briefly(
    judged: &Judged,
    product: &mbs::Mechanism,
    method: Way,
    step: f64,
    steps: u32,
) -> Verdict {
    if method[1] != "trapezoidal" {
        match rows(product, method, (step, steps), 1) {
            Err(verdict) => return verdict,
            Ok(rows) if rows.len() == judged.rows.len() => {
                if compare(judged, &judged.rows, &rows, &rows) == Verdict::Agrees {
                    return Verdict::Agrees;
                }
            }
            Ok(_) => {}
        }
    }
    trial(judged, product, method, step, steps)
}

/// The kind of a refusal: its message without quoted names.
fn reason(message: &str) -> String {
    message.split('`').step_by(2).collect::<Vec<_>>().join("..")
}
