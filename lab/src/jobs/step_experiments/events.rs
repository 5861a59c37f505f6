//! Experiment on the benefit of steps that end at contacts and at kinks of the road.

use super::draw::{INDEX_1, INDEX_3, curve, points};
use super::fit::{between, median, span};
use super::reference::Watched;
use super::rows::{HEAD, cell, row_with};
use crate::chart::Chart;
use crate::format::{self, error, ratio};
use crate::lab::case::{Case, Rule};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};

/// Scenes with their watched channels: the wheel after the bump, the nose of the vehicle on the stairs, and every channel after the blow.
pub(crate) const SCENES: [Watched; 3] = [
    Watched {
        scene: "iltis-suspension-stiff",
        channel: "wheel",
        unit: "m",
        time: Some(3.3),
        digits: &[],
    },
    Watched { scene: "iltis-stairs", channel: "nose", unit: "m", time: Some(6.5), digits: &[] },
    super::hammer::WATCHED,
];
/// First and largest step [s].
const STEPS: [f64; 2] = [1e-3, 2e-2];
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 3;

/// Runs the experiment on steps that end at events.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section = Section::new("C", "Steps that end at events");
    section.words(
        "Index 3 with steps chosen by the estimate of their error, with and without steps that end where contacts begin and end and \
        where the road has a kink. Reaching an event costs steps; stepping over it costs rejections, or accuracy.",
    );
    for watched in &SCENES {
        section.heading(watched.scene);
        let Some(reference) = watched.reference(lab)? else {
            section.words("There is no such scene, or no reference could be computed: left out.");
            continue;
        };
        section.words(reference.sentence(watched));
        let runs = watched.measure(lab, &reference, &cases(watched, lab.quick), REPEATS)?;
        scene(watched, &runs, &mut section);
        section.runs.extend(runs);
    }
    Ok(section)
}

fn cases(watched: &Watched, quick: bool) -> Vec<Case> {
    let tightest = if quick { 6 } else { 8 };
    let tolerances = (3..=tightest).map(|k| 10_f64.powi(-k));
    let case = |tolerance| watched.case(Rule::Error(tolerance), STEPS);
    tolerances.flat_map(|t| [true, false].map(|events| case(t).with_events(events))).collect()
}

fn scene(watched: &Watched, runs: &[Run], section: &mut Section) {
    let head = [&HEAD[..6], &["steps to events", "true error"]].concat();
    let row = |run: &Run| {
        let events = run.figures().and_then(|f| f.control).map(|c| c.events.to_string());
        let mut cells = row_with(run, [events.unwrap_or_default(), cell(run.true_error, error)]);
        // the smallest step and the steps in index 1 are left out here
        if cells.len() > head.len() {
            cells.drain(6..8);
        }
        cells
    };
    section.behind("Every run", &head, runs.iter().map(row).collect());
    section.words(reached(runs));
    let of = |events: bool, number: &dyn Fn(&Run) -> Option<f64>| {
        points(runs.iter().filter(|run| run.case.events == Some(events)), Run::seconds, number)
    };
    let draw =
        |section: &mut Section, what: &str, label: &str, number: &dyn Fn(&Run) -> Option<f64>| {
            let (on, off) = (of(true, number), of(false, number));
            let ratios: Vec<_> =
                on.iter().filter_map(|[s, e]| Some(e / between(&off, *s)?)).collect();
            let compared = span(ratios.iter().copied()).zip(median(ratios));
            let compared = compared.map_or(String::new(), |(ends, middle)| {
                let middle = ratio(middle);
                format!(
                    " At equal time it is with events {} that without ({middle} in the middle).",
                    format::ratios(ends)
                )
            });
            let series = vec![curve("events off", INDEX_1, off), curve("events on", INDEX_3, on)];
            section.figure(
                &Chart::log_log("CPU [s]", label, series),
                &format!("{what} over CPU time.{compared}"),
            );
        };
    draw(section, "True error", &watched.label(), &|run| run.true_error);
    draw(section, "Largest energy error", "largest energy error [J]", &Run::energy_error);
}

/// Sentence with the numbers of steps that ended at events.
fn reached(runs: &[Run]) -> String {
    let on = runs.iter().filter(|run| run.case.events == Some(true));
    let counts = on.filter_map(|run| run.figures()?.control).map(|control| control.events);
    match (counts.clone().min(), counts.max()) {
        (Some(_), Some(0)) => {
            "No step ended at an event: with and without are the same.".to_owned()
        }
        (Some(least), Some(most)) => {
            format!("With events on, {least} to {most} steps ended at one.")
        }
        _ => "No run with events on came to its end.".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mbs::outcome::{Control, Figures, Outcome};

    #[test]
    fn steps_that_ended_at_events_are_counted() {
        let run = |case: &Case, events| {
            let control = Some(Control { events, ..Control::default() });
            let outcome = Outcome::Completed(Figures { control, ..Figures::default() });
            Run { case: case.clone(), outcome, true_error: None }
        };
        let cases = cases(&SCENES[0], true);
        let with =
            |events: [u64; 2]| reached(&[run(&cases[0], events[0]), run(&cases[2], events[1])]);
        assert_eq!(with([3, 12]), "With events on, 3 to 12 steps ended at one.");
        assert!(with([0, 0]).contains("the same"));
        assert!(
            reached(&[run(&cases[1], 5)]).contains("No run"),
            "those with events off do not count"
        );
    }
}
