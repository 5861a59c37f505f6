//! Experiment of the report on the front suspension over its bump: fixed steps, and controlled steps with changes of index. It corresponds
//! to Figures 6 and 7 of the report, and Figures 10 to 12 of its second publication.

mod histories;

use super::draw::work_precision;
use super::fit::span;
use super::rows::{HEAD, cell, row_with};
use crate::format::{self, error, ratio, seconds};
use crate::lab::case::{Case, Rule, size};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};
use histories::{COARSE, FINE};

/// Scenes of the experiment: one with the damper as published, and one in which the bump compresses the suspension to its rubber stop.
const SCENES: [&str; 2] = ["iltis-suspension-halved", "iltis-suspension-stiff"];
/// First step of the controlled run [s].
const FIRST_STEP: f64 = 1e-3;
/// Tolerance of the report [-].
const TOLERANCE: f64 = 1e-6;
/// Tolerances of the controlled runs [-].
const TOLERANCES: [f64; 3] = [1e-5, TOLERANCE, 1e-7];
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 5;
/// Published CPU times, in the order of the report's runs [s].
const PRINTED: [f64; 3] = [8.41, 36.07, 155.0];

/// Claimed largest ratio of CPU time to that of index 1 [-].
const QUARTER: f64 = 0.25;
/// Claimed largest ratio of CPU time to that of the cheapest fixed step [-].
const CHEAPEST: f64 = 0.7;

/// Runs the experiment on the front suspension.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section =
        Section::new("F6", "Front suspension over a bump: the report's own experiment");
    section.words(
        "The suspension settles from rest off its equilibrium, and meets a bump from 3.0 to 3.2 s. The report runs it in index 3 with \
        a fixed step of 1e-2 s, with steps and index of its own (first step 1e-3 s, tolerances 1e-6 and 1e-8 of the energy turned \
        over), and in index 1 with a fixed step of 5e-4 s. The rule of energy also steers the step between its two tolerances; as \
        printed, the step stays there. Times are the least of 5 runs in turn; the report's are those of its \
        authors' machine.",
    );
    for scene in SCENES {
        section.heading(scene);
        experiment(lab, scene, &mut section)?;
    }
    Ok(section)
}

fn multi(scene: &'static str, tolerance: f64) -> Case {
    Case::variable(scene, "multi-index", Rule::Energy(tolerance), [FIRST_STEP, COARSE])
}

/// The report's three runs.
fn printed(scene: &'static str) -> [Case; 3] {
    [
        Case::fixed(scene, "index-3", COARSE),
        multi(scene, TOLERANCE),
        Case::fixed(scene, "index-1", FINE),
    ]
}

/// Every case of a scene: the report's three, other tolerances, and a sweep of fixed steps around that of index 1.
fn cases(scene: &'static str, quick: bool) -> Vec<Case> {
    let mut cases = printed(scene).to_vec();
    let tolerances = TOLERANCES.into_iter().filter(|t| !quick || *t >= TOLERANCE);
    for tolerance in tolerances {
        let ours = multi(scene, tolerance);
        let as_printed = Case { rule: Rule::Printed(tolerance), ..ours.clone() };
        cases.extend([ours, as_printed].into_iter().filter(|case| !printed(scene).contains(case)));
    }
    for quarter in -2..=8 {
        let step = FINE * 2_f64.powf(f64::from(quarter) / 4.0);
        let both = ["index-1", "index-3"].map(|formulation| Case::fixed(scene, formulation, step));
        cases.extend(both.into_iter().filter(|case| !printed(scene).contains(case)));
    }
    cases
}

fn experiment(lab: &Lab<'_>, scene: &'static str, section: &mut Section) -> Result<(), String> {
    let mut runs = lab.measure(&cases(scene, lab.quick), REPEATS)?;
    extend(lab, scene, &mut runs)?;
    let [_, multi, index_1, ..] = &runs[..] else { return Err("too few runs".into()) };
    report(&runs[..3], section);
    claims(multi, index_1, &runs, section);
    at_equal_error(&runs, section);
    let records = printed(scene).map(|case| lab.record(&case, &["wheel.z"]));
    let [coarse, variable, fine] = records;
    histories::draw([coarse?, variable?, fine?], section);
    section.figure(
        &work_precision(&runs, "largest energy error [J]", Run::energy_error),
        "Largest energy error over CPU time, of every run: lower and further left is better.",
    );
    section.runs.extend(runs);
    Ok(())
}

/// Adds runs with halved fixed steps, until one formulation has an error as small as that of every controlled run. So every controlled run
/// can be compared.
fn extend(lab: &Lab<'_>, scene: &'static str, runs: &mut Vec<Run>) -> Result<(), String> {
    let most = if lab.quick { 1 } else { 4 };
    let is_variable = |run: &&Run| run.case.rule != Rule::Fixed;
    let Some([least, _]) = span(runs.iter().filter(is_variable).filter_map(Run::energy_error))
    else {
        return Ok(());
    };
    let finest = FINE / std::f64::consts::SQRT_2;
    for halvings in 1..=most {
        if cheapest(runs, least).is_some() {
            break;
        }
        let step = finest * 2_f64.powi(-halvings);
        let both = ["index-1", "index-3"].map(|f| Case::fixed(scene, f, step));
        runs.extend(lab.measure(&both, REPEATS)?);
    }
    Ok(())
}

/// The cheapest fixed-step run whose largest energy error is at most this [J].
fn cheapest(runs: &[Run], at_most: f64) -> Option<&Run> {
    let fixed = runs.iter().filter(|run| run.case.rule == Rule::Fixed);
    let reach = fixed.filter(|run| run.energy_error().is_some_and(|e| e <= at_most));
    reach.filter(|run| run.seconds().is_some()).min_by(|a, b| {
        let [a, b] = [a, b].map(|run| run.seconds().unwrap_or(f64::INFINITY));
        a.total_cmp(&b)
    })
}

/// Table of the report's three runs with its published figures.
fn report(runs: &[Run], section: &mut Section) {
    let head = [&HEAD[..], &["CPU / index 1", "report's CPU [s]", "report's ratio"]].concat();
    let slowest = runs.last().and_then(Run::seconds);
    let rows = runs.iter().zip(PRINTED).map(|(run, printed)| {
        let share = run.seconds().zip(slowest).map(|(a, b)| a / b);
        let last = PRINTED[PRINTED.len() - 1];
        row_with(run, [cell(share, ratio), printed.to_string(), ratio(printed / last)])
    });
    section.table(&head, rows.collect());
}

fn claims(multi: &Run, index_1: &Run, runs: &[Run], section: &mut Section) {
    let what = format!(
        "{}: at most 1/4 of the CPU time of index 1 at {FINE:e} s, at no larger energy error",
        multi.case.scene
    );
    let (Some(ours), Some(theirs)) = (multi.figures(), index_1.figures()) else {
        return section.claim(what, "one of the two did not reach its end".into(), None);
    };
    let share = ours.seconds / theirs.seconds;
    let reaches = ours.energy_error <= theirs.energy_error;
    let errors = format!(
        "energy error {} J against {} J",
        error(ours.energy_error),
        error(theirs.energy_error)
    );
    section.claim(
        what,
        format!("ratio {}, {errors}", ratio(share)),
        Some(share <= QUARTER && reaches),
    );

    let what = format!(
        "{}: at most 0.7 of the CPU time of the cheapest fixed step that reaches the energy error of index 1 at {FINE:e} s",
        multi.case.scene
    );
    let Some(best) = cheapest(runs, theirs.energy_error) else { return };
    let best_seconds = best.seconds().unwrap_or(f64::INFINITY);
    let share = ours.seconds / best_seconds;
    let reaching = if reaches { "reaches it" } else { "does not reach it" };
    let measured = format!(
        "ratio {}: {} takes {} s and {reaching}, the cheapest, {}, {} s",
        ratio(share),
        multi.case.name(),
        seconds(ours.seconds),
        best.case.name(),
        seconds(best_seconds)
    );
    section.claim(what, measured, Some(share <= CHEAPEST && reaches));
}

/// Compares each controlled run with the cheapest fixed step whose error is no larger.
fn at_equal_error(runs: &[Run], section: &mut Section) {
    let variable: Vec<_> = runs.iter().filter(|run| run.case.rule != Rule::Fixed).collect();
    let mut ratios = Vec::new();
    let rows = variable.iter().map(|run| {
        let Some(figures) = run.figures() else {
            return vec![run.case.name(), run.outcome.reason()];
        };
        let mut cells =
            vec![run.case.name(), error(figures.energy_error), seconds(figures.seconds)];
        let best = cheapest(runs, figures.energy_error);
        let share = best.and_then(Run::seconds).map(|s| figures.seconds / s);
        ratios.extend(share);
        cells.push(best.map_or("none of the sweep".into(), |best| best.case.name()));
        cells.extend([
            cell(best.and_then(Run::energy_error), error),
            cell(best.and_then(Run::seconds), seconds),
        ]);
        cells.push(cell(share, ratio));
        cells
    });
    let rows: Vec<_> = rows.collect();
    let head = [
        "run",
        "energy error [J]",
        "CPU [s]",
        "cheapest fixed step",
        "its error [J]",
        "its CPU [s]",
        "ratio of CPU",
    ];
    section.table(&head, rows);
    let within = ratios.iter().filter(|r| **r <= CHEAPEST).count();
    let fixed = runs.iter().filter(|run| run.case.rule == Rule::Fixed);
    let finest = fixed.map(|run| run.case.step).fold(FINE, f64::min);
    if let Some(ends) = span(ratios.iter().copied()) {
        section.words(format!(
            "At equal error the variable runs take {} the time of the cheapest fixed step; at most 0.7 of it in {within} of {}. The fixed \
            steps are those of index 1 and index 3 from {} down to {} s, most of them in ratios of the fourth root of 2.",
            format::ratios(ends),
            ratios.len(),
            size(4.0 * FINE),
            size(finest)
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mbs::outcome::{Figures, Outcome};

    const SCENE: &str = SCENES[0];

    fn of(case: Case, energy_error: f64, seconds: f64) -> Run {
        let figures = Figures { energy_error, seconds, ..Figures::default() };
        Run { case, outcome: Outcome::Completed(figures), true_error: None }
    }

    #[test]
    fn the_sweep_has_each_step_once_and_the_report_s_runs_first() {
        let cases = cases(SCENE, false);
        assert_eq!(cases[..3], printed(SCENE));
        assert_eq!(cases.len(), 3 + 2 + 3 + 2 * 11 - 1);
        let twice = cases.iter().enumerate().any(|(i, case)| cases[..i].contains(case));
        assert!(!twice, "no case is run twice");
    }

    #[test]
    fn claims_are_compared_with_the_cheapest_step_that_reaches_the_error() {
        let fixed = |formulation, step, e, s| of(Case::fixed(SCENE, formulation, step), e, s);
        let coarse = fixed("index-3", 1e-3, 2e-3, 0.2);
        let runs = [fixed("index-1", FINE, 1e-3, 1.0), fixed("index-3", FINE, 9e-4, 0.5), coarse];
        assert_eq!(cheapest(&runs, 1e-3), Some(&runs[1]));
        assert_eq!(cheapest(&runs, 1e-4), None);
        let judged = |energy_error, seconds| {
            let mut section = Section::new("F6", "title");
            let multi = of(multi(SCENE, TOLERANCE), energy_error, seconds);
            claims(&multi, &runs[0], &runs, &mut section);
            section.claims().map(|claim| claim.holds).collect::<Vec<_>>()
        };
        assert_eq!(judged(1e-3, 0.2), [Some(true), Some(true)]);
        assert_eq!(judged(2e-3, 0.2), [Some(false), Some(false)], "the error is too large");
        assert_eq!(judged(1e-3, 0.4), [Some(false), Some(false)], "too slow");
        assert_eq!(judged(1e-3, 0.3), [Some(false), Some(true)]);
    }
}
