//! Experiment on the need for a change of index. The same rule, with steps much smaller than 1e-4 s, is used with changes between both
//! indices and with each index alone.

use super::draw::work_precision;
use super::fit::span;
use super::rows::{HEAD, row};
use crate::format::ratios;
use crate::lab::case::{Case, Rule, size};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};

/// Scenes, with the first and the largest step [s].
const SCENES: [(&str, [f64; 2]); 3] = [
    ("double-pendulum", [1e-4, 1e-2]),
    ("two-four-bars", [1e-4, 1e-2]),
    ("iltis-suspension-halved", [1e-4, 1e-2]),
];
/// The formulations; the one that changes between both indices is first.
const FORMULATIONS: [&str; 3] = ["multi-index", "index-3", "index-1"];
/// Exponents of the tolerances.
const TIGHT: [i32; 4] = [9, 10, 11, 12];
/// The step below which the publication changes to index 1 [s].
const THRESHOLD: f64 = 1e-4;
/// Ratio of two errors above which the larger one is reported as worse [-].
const WORSE: f64 = 2.0;
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 3;

/// Runs the experiment on the change of index.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section = Section::new("A", "Is the change of index needed?");
    section.words(format!(
        "The rule of energy with tolerances so tight that steps fall below {THRESHOLD:e} s, where the publication leaves index 3: with \
        both indices, and with each alone. A run that stops says why."
    ));
    for (scene, steps) in SCENES {
        section.heading(scene);
        let runs = lab.measure(&cases(scene, steps, lab.quick), REPEATS)?;
        section.table(&HEAD, runs.iter().map(row).collect());
        section.words(needed(&runs));
        section.figure(
            &work_precision(&runs, "largest energy error [J]", Run::energy_error),
            "Largest energy error over CPU time under the same rule, one mark for each tolerance.",
        );
        section.runs.extend(runs);
    }
    Ok(section)
}

fn cases(scene: &'static str, steps: [f64; 2], quick: bool) -> Vec<Case> {
    let n = if quick { 2 } else { TIGHT.len() };
    let rules = TIGHT[..n].iter().map(|k| Rule::Energy(10_f64.powi(-k)));
    let each =
        |rule| FORMULATIONS.map(|formulation| Case::variable(scene, formulation, rule, steps));
    rules.flat_map(each).collect()
}

/// Sentence on the results, from triples of runs with the same tolerance in the order of the formulations.
fn needed(runs: &[Run]) -> String {
    let smallest = runs.iter().filter_map(|r| r.figures()?.control).map(|c| c.steps[0]);
    let reached = span(smallest).map_or("No run came to its end.".to_owned(), |[least, _]| {
        let side = if least < THRESHOLD { "below" } else { "not below" };
        format!("The smallest step of all runs is {} s, {side} the threshold.", size(least))
    });
    let (mut errors, mut times, mut helped, mut judged) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for triple in runs.chunks_exact(FORMULATIONS.len()) {
        let [both, alone, _] = triple else { continue };
        let Some(ours) = both.figures() else { continue };
        judged += 1;
        let tolerance = size(both.case.tolerance().unwrap_or(0.0));
        if let Some(alone) = alone.figures() {
            errors.push(alone.energy_error / ours.energy_error);
            times.push(alone.seconds / ours.seconds);
            if alone.energy_error > WORSE * ours.energy_error {
                helped.push(format!("{tolerance} (smaller error)"));
            }
        } else {
            helped.push(format!("{tolerance} (index 3 alone stops)"));
        }
    }
    let spans = span(errors).zip(span(times)).map_or(String::new(), |(e, s)| {
        format!(
            " Index 3 alone has {} the energy error of both indices, in {} their CPU time.",
            ratios(e),
            ratios(s)
        )
    });
    let verdict = match (judged, helped.is_empty()) {
        (0, _) => " Both indices together came to no end: nothing can be said.".to_owned(),
        (_, true) => " The change of index is not needed here at any tolerance.".to_owned(),
        _ => format!(" The change of index helps at {}.", helped.join(", ")),
    };
    reached + &spans + &verdict
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mbs::outcome::{Control, Figures, Outcome};

    fn runs(alone: Outcome) -> Vec<Run> {
        let control = Control { steps: [2e-5, 1e-3], ..Control::default() };
        let figures = Figures {
            energy_error: 1e-6,
            seconds: 2.0,
            control: Some(control),
            ..Figures::default()
        };
        let outcomes = [Outcome::Completed(figures.clone()), alone, Outcome::Completed(figures)];
        let cases = cases("double-pendulum", [1e-4, 1e-2], true);
        let run = |(case, outcome)| Run { case, outcome, true_error: None };
        cases.into_iter().zip(outcomes).map(run).collect()
    }

    #[test]
    fn the_change_is_needed_where_index_3_stops_or_errs() {
        let alone = |energy_error| {
            Outcome::Completed(Figures { energy_error, seconds: 1.0, ..Figures::default() })
        };
        let sentence = needed(&runs(alone(1.5e-6)));
        assert!(
            sentence.contains("2e-5 s, below the threshold") && sentence.contains("not needed"),
            "{sentence}"
        );
        assert!(
            sentence.contains("1.50 times the energy error") && sentence.contains("0.50 times")
        );
        assert!(needed(&runs(alone(3e-6))).contains("helps at 1e-9 (smaller error)"));
        assert!(needed(&runs(Outcome::NotBuilt)).contains("helps at 1e-9 (index 3 alone stops)"));
    }
}
