//! Section of the table D1: errors and times of all forms, a drawing for each scene, and claims on the runs.

use super::cell::{self, CORRECTION, Cell, LADDERS, OURS, PAIRS, PRINTED, REFINED, SCENES, WAYS};
use super::outcome::Run;
use crate::chart::{Chart, Look, Series};
use crate::format::{ratio, ratios, step};
use crate::lab::section::Section;

/// Largest ratio of two errors that count as equal [-]: the tables show two digits.
const SAME_ERROR: f64 = 1.1;

/// Introduction of the section.
const WORDS: &str = "The report finds index-3 ill-conditioned at small steps, and guesses that \"a precision environment of \
    32 digits\" could be the cure. Printed: fixed alpha, multipliers from zero, projections that solve for the vector itself \
    (publication 1, (13) and (19)). dd computes in pairs of doubles, 32 digits; refined takes the factor in doubles and refines \
    each solution to 32 digits with residuals in pairs, once leaves it with what the factor gives. Correction is our form of \
    the projections, compensated and with filtered multipliers, at the same alpha; default scales the penalty by step and mass, \
    and follows the most weakly determined constraint. All iterate to the same tolerance.";

/// The section of all cells.
pub(super) fn section(cells: &[Cell]) -> Section {
    let mut section =
        Section::new("D1", "Small steps in index-3: what 32 digits cure, and at what price");
    section.words(WORDS);
    for scene in SCENES {
        let these: Vec<_> = cells.iter().filter(|cell| cell.scene == scene).collect();
        section.heading(format!("{}, 1 s: largest energy error [J]", scene.what));
        section.table(&head("step [s], alpha"), errors(&these));
        section.words("Time of a step [µs] by the wall clock, as the machine was loaded; in brackets beside the printed form in f64 at the same step and alpha:");
        section.table(&head("step [s], alpha"), prices(&these));
        if let Some((ladder, chart)) = drawing(&these) {
            let caption = format!(
                "alpha = {}, where most runs of 32 digits reach the end. What stopped has no mark: its reason is below.",
                LADDERS[ladder].name
            );
            section.figure(&chart, &caption);
        }
        section.behind("Every run", &cell::HEAD, cell::rows(these.iter().copied()));
        judge(&mut section, scene.what, &these);
    }
    section
}

fn head(first: &'static str) -> Vec<&'static str> {
    std::iter::once(first).chain(WAYS.map(|way| way.name)).collect()
}

fn name(cell: &Cell) -> String {
    format!("{}, 1e{}", step(cell.step()), cell.exponent)
}

fn errors(cells: &[&Cell]) -> Vec<Vec<String>> {
    let row =
        |cell: &&Cell| std::iter::once(name(cell)).chain(cell.runs.iter().map(Run::text)).collect();
    cells.iter().map(row).collect()
}

/// Times per step in microseconds, and their ratios to the first one.
fn prices(cells: &[&Cell]) -> Vec<Vec<String>> {
    let row = |cell: &&Cell| {
        let first = seconds(&cell.runs[PRINTED]);
        let time_of = |run: &Run| {
            let Some(time) = seconds(run) else { return String::new() };
            let beside = first.map(|first| format!(" ({})", ratio(time / first)));
            format!("{:.2}{}", time * 1e6, beside.unwrap_or_default())
        };
        std::iter::once(name(cell)).chain(cell.runs.iter().map(time_of)).collect()
    };
    cells.iter().map(row).collect()
}

/// Time per step, if the run made steps.
fn seconds(run: &Run) -> Option<f64> {
    match run {
        Run::Made(figures) if figures.steps > 0.0 => Some(figures.seconds),
        _ => None,
    }
}

/// Error over step, for the choice of the penalty with which most runs of 32 digits are completed. Among equal choices it is the first one.
fn drawing(cells: &[&Cell]) -> Option<(usize, Chart)> {
    let of = |ladder: usize| cells.iter().filter(move |cell| cell.is_on(&LADDERS[ladder]));
    let ends =
        |ladder: &usize| of(*ladder).filter(|cell| cell.runs[PAIRS].completed().is_some()).count();
    let ladder = (0..LADDERS.len()).rev().max_by_key(ends)?;
    let series = WAYS.iter().enumerate().map(|(style, way)| {
        let point = |cell: &&Cell| Some([cell.step(), cell.runs[style].completed()?.energy_error]);
        let mut points: Vec<_> = of(ladder).filter_map(point).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Series::new(way.name, style, Look::Both, points)
    });
    let series: Vec<_> = series.collect();
    let n = series.iter().flat_map(|s| &s.points).count();
    (n > 1).then(|| (ladder, Chart::log_log("step [s]", "largest energy error [J]", series)))
}

/// Adds the claims on a scene, with the verdict of its runs.
fn judge(section: &mut Section, what: &str, cells: &[&Cell]) {
    let scene = what.split(':').next().unwrap_or(what);
    for (way, claim) in [
        (PAIRS, "32 digits cure the printed form: its error is ours wherever ours reaches the end"),
        (REFINED, "a factor of 16 digits, refined, cures it as well"),
        (CORRECTION, "16 digits are enough at the same alpha, with projections in correction form"),
    ] {
        let same = cells.iter().filter(|cell| is_same(cell, way)).count();
        let stops = cells.iter().filter(|cell| cell.runs[way].completed().is_none()).count();
        let all = cells.iter().filter(|cell| cell.runs[OURS].completed().is_some()).count();
        let printed = cells.iter().filter(|cell| is_same(cell, PRINTED)).count();
        let measured = format!(
            "the same error as the default in {same} of {all} entries (printed in f64: {printed}), {stops} stop"
        );
        section.claim(format!("{scene}: {claim}"), measured, (all > 0).then_some(same == all));
    }
    let beside = |a: usize, b: usize| {
        let quotient = |cell: &&Cell| {
            let [a, b] = [a, b].map(|way| cell.runs[way].completed().map(|f| f.seconds));
            Some(a? / b?)
        };
        let all: Vec<f64> = cells.iter().filter_map(quotient).collect();
        let [low, high] = [f64::min, f64::max].map(|pick| all.iter().copied().reduce(pick));
        Some([low?, high?])
    };
    let stops = |way: usize| move |cell: &&&Cell| cell.runs[way].completed().is_none();
    let both = [
        cells.iter().filter(stops(PAIRS)).count(),
        cells.iter().filter(stops(PAIRS)).filter(stops(PRINTED)).count(),
    ];
    section.claim(
        format!("{scene}: where the printed form stops with 32 digits it does so with 16: the penalty is too weak there"),
        format!("{} of {} entries", both[1], both[0]),
        (both[0] > 0).then_some(both[0] == both[1]),
    );
    let refined = beside(REFINED, PAIRS);
    section.claim(
        format!("{scene}: a refined factor costs less than a factor in pairs"),
        refined.map_or("no run of both".to_owned(), |span| {
            format!("its step takes {} the time of dd", ratios(span))
        }),
        refined.map(|[_, high]| high < 1.0),
    );
    for (way, name) in [(PRINTED, "the printed form in f64"), (OURS, "our default")] {
        if let Some(span) = beside(PAIRS, way) {
            section.words(format!(
                "{scene}: where both reach the end, a step of the printed form with 32 digits takes {} the time of {name}.",
                ratios(span)
            ));
        }
    }
}

/// True if the run of this form was completed, with at most the error of our default form.
fn is_same(cell: &Cell, way: usize) -> bool {
    let error = |way: usize| cell.runs[way].completed().map(|f| f.energy_error);
    matches!((error(way), error(OURS)), (Some(a), Some(b)) if a <= SAME_ERROR * b)
}

#[cfg(test)]
mod tests {
    use super::super::cells;
    use super::*;
    use serde_json::json;

    /// Made-up runs of second order. In f64 the published form has an additional error proportional to alpha. The published form stops in
    /// the four-bars.
    fn made() -> Vec<Cell> {
        cells(false, |words| {
            let [_, scene, form, digits, step, _, alpha] = words else { panic!("{words:?}") };
            let [step, alpha]: [f64; 2] = [step, alpha].map(|text| text.parse().unwrap());
            let lost = if (*form, *digits) == ("printed", "f64") { alpha * 1e-16 } else { 0.0 };
            let time = if *digits == "dd" { 4e-5 } else { 2e-6 };
            let mut line = json!({
                "energy_error": 8e2 * step * step + lost, "turned_over": 70.0, "violation": [0.0, 0.0, 0.0], "steps": 100,
                "iterations": 2.0, "seconds": time,
            });
            if *scene == "two-four-bars" && *form == "printed" {
                (line["stopped_at"], line["reason"]) = (json!(0.71), json!("no <convergence>"));
            }
            Run::read(Ok(vec![line]))
        })
    }

    #[test]
    fn claims_are_compared_with_the_runs() {
        let section = section(&made());
        let holds: Vec<_> = section.claims().map(|claim| claim.holds).collect();
        let (yes, no) = (Some(true), Some(false));
        assert_eq!(holds, [yes, yes, yes, None, yes, no, no, yes, yes, None]);
        let text = section.text();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            text.contains("in 13 of 13 entries") && text.contains("in 0 of 13 entries"),
            "{text}"
        );
        assert!(text.contains("takes 20.0 times the time of our default"), "{text}");
        assert!(text.contains("stops at 0.71 s") && text.contains("2.00 (1.00)"), "{text}");
    }

    #[test]
    fn the_page_has_every_run_with_its_reason_and_draws_what_reaches_the_end() {
        let html = section(&made()).html();
        assert_eq!(html.matches("no &lt;convergence&gt;").count(), 13 * 4);
        assert_eq!(html.matches("<figure>").count(), 2);
        assert!(!html.contains("NaN") && !html.contains("No drawing"));
        let csv = String::from_utf8(cell::csv(&made()).unwrap()).unwrap();
        assert_eq!(csv.lines().count(), 1 + 2 * 13 * WAYS.len());
    }
}
