//! Experiment on a short blow in a long run: controlled steps, compared with the fixed step that is small enough for the blow.

use super::draw::work_precision;
use super::reference::{Reference, Watched};
use super::rows::{HEAD, cell, row_with};
use crate::format::{error, ratio, seconds};
use crate::lab::case::{Case, Rule, size};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};

/// Channel that is watched, with its exact value.
///
/// The time is halfway back after the blow. The value follows from the closed form in the scene's file.
pub(crate) const WATCHED: Watched = Watched {
    scene: "hammer-blow",
    channel: "angle",
    unit: "rad",
    time: Some(7.5),
    digits: &[0.565_606_072_417_484],
};
/// First and largest step of the variable runs [s].
const STEPS: [f64; 2] = [1e-3, 5e-2];
/// The largest fixed step [s].
const COARSEST: f64 = 1e-2;
/// Largest number of halvings of the fixed step.
const HALVINGS: i32 = 16;
/// Time of a run after which no smaller fixed step is tried [s].
const LONG: f64 = 60.0;
/// Claimed least ratio of the CPU time of the fixed step to that of controlled steps [-].
const CLAIM: f64 = 10.0;
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 3;

/// Runs the experiment on the blow of a hammer.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section = Section::new(
        "H",
        "A hammer blow: variable steps against the fixed step that works everywhere",
    );
    section.words(
        "Index 3 with steps chosen by the estimate of their error, beside fixed steps, halved until their true error is at most that of \
        the variable run and stays there.",
    );
    let Some(reference) = WATCHED.reference(lab)? else {
        section.words("There is no such scene, or no reference could be computed: left out.");
        return Ok(section);
    };
    section.words(reference.sentence(&WATCHED));
    let tightest = if lab.quick { 5 } else { 7 };
    let rules = (3..=tightest).map(|k| Rule::Error(10_f64.powi(-k)));
    let variable: Vec<_> = rules.map(|rule| WATCHED.case(rule, STEPS)).collect();
    let mut runs = WATCHED.measure(lab, &reference, &variable, REPEATS)?;
    let n = runs.len();
    runs.extend(fixed(lab, &reference, &runs)?);
    let (variable, fixed) = runs.split_at(n);
    for run in variable {
        claim(run, fixed, &mut section);
    }
    let head = [&HEAD[..], &["true error"]].concat();
    section.table(
        &head,
        runs.iter().map(|run| row_with(run, [cell(run.true_error, error)])).collect(),
    );
    section.figure(
        &work_precision(&runs, &WATCHED.label(), |run| run.true_error),
        "True error over CPU time: the distance to the right, at equal error, is what the variable steps save.",
    );
    section.runs = runs;
    Ok(section)
}

/// Runs with fixed steps. The step is halved until two runs in succession have an error as small as every controlled run, or until a run
/// takes long.
fn fixed(lab: &Lab<'_>, reference: &Reference, variable: &[Run]) -> Result<Vec<Run>, String> {
    let least = variable.iter().filter_map(|run| run.true_error).fold(f64::INFINITY, f64::min);
    let mut runs: Vec<Run> = Vec::new();
    for halving in 0..=HALVINGS {
        let case = Case::fixed(WATCHED.scene, "index-3", COARSEST / 2_f64.powi(halving));
        let case = case.lasting(WATCHED.time);
        runs.extend(WATCHED.measure(lab, reference, &[case], REPEATS)?);
        let enough = |run: &Run| run.true_error.is_some_and(|e| e <= least);
        let is_long = runs.last().and_then(Run::seconds).is_some_and(|s| s > LONG);
        if is_long || (runs.len() > 1 && runs.iter().rev().take(2).all(enough)) {
            break;
        }
    }
    Ok(runs)
}

/// The run with the largest fixed step such that this step and all smaller ones have errors of at most `at_most`.
fn largest(fixed: &[Run], at_most: f64) -> Option<&Run> {
    fixed.iter().rev().take_while(|run| run.true_error.is_some_and(|e| e <= at_most)).last()
}

fn claim(run: &Run, fixed: &[Run], section: &mut Section) {
    let tolerance = size(run.case.tolerance().unwrap_or(0.0));
    let what = format!(
        "hammer-blow at tolerance {tolerance}: the fixed step takes at least {CLAIM} times the CPU time"
    );
    let (Some(ours), Some(true_error)) = (run.seconds(), run.true_error) else {
        return section.claim(what, format!("the variable run: {}", run.outcome.reason()), None);
    };
    let Some(best) = largest(fixed, true_error) else {
        // even the smallest step is too large: its time gives a lower bound of the ratio
        let bound = fixed.iter().filter_map(Run::seconds).fold(0.0, f64::max) / ours;
        let measured = format!(
            "no fixed step of the sweep reaches {}; the ratio is above {}",
            error(true_error),
            ratio(bound)
        );
        return section.claim(what, measured, (bound >= CLAIM).then_some(true));
    };
    let theirs = best.seconds().unwrap_or(0.0);
    let measured = format!(
        "ratio {}: {} s against {} s with {} s fixed, errors {} and {}",
        ratio(theirs / ours),
        seconds(ours),
        seconds(theirs),
        size(best.case.step),
        error(true_error),
        cell(best.true_error, error)
    );
    section.claim(what, measured, Some(theirs / ours >= CLAIM));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mbs::outcome::{Figures, Outcome};

    fn at(step: f64, true_error: f64) -> Run {
        let figures = Figures { seconds: 1.0 / step, ..Figures::default() };
        let case = Case::fixed("hammer-blow", "index-3", step);
        Run { case, outcome: Outcome::Completed(figures), true_error: Some(true_error) }
    }

    #[test]
    fn a_lucky_coarse_step_does_not_count() {
        let sweep = [at(8e-3, 1e-9), at(4e-3, 1e-2), at(2e-3, 1e-3), at(1e-3, 1e-4)];
        let step = |at_most| largest(&sweep, at_most).map(|run| run.case.step);
        assert_eq!(step(2e-3), Some(2e-3));
        assert_eq!(step(1.0), Some(8e-3));
        assert_eq!(step(1e-5), None);
    }
}
