//! Experiment on the effect of a tolerance: true error over tolerance, for the estimate of the error of a step, for the energy, and for
//! both.

use super::draw::{INDEX_1, INDEX_3, MULTI, curve, points};
use super::reference::{Reference, Watched};
use super::rows::{HEAD, cell, row_with};
use super::sight::{self, Sight};
use crate::chart::Chart;
use crate::chart::Series;
use crate::format::{error, step};
use crate::lab::case::{Case, Rule};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};

/// Scenes with their watched channels, and the first and the largest step [s].
const SCENES: [(Watched, [f64; 2]); 6] = [
    (
        Watched {
            scene: "double-pendulum",
            channel: "tip",
            unit: "m",
            time: Some(3.0),
            digits: &[1.330_436_825_144_049, -1.398_644_860_519_204],
        },
        [1e-3, 0.06],
    ),
    (
        Watched {
            scene: "two-four-bars",
            channel: "crank-end",
            unit: "m",
            time: Some(10.0),
            digits: &[0.328_458_111_540_815_4, 0.944_518_538_178_600_9],
        },
        [1e-3, 0.2],
    ),
    (
        Watched {
            scene: "andrews",
            channel: "beta",
            unit: "rad",
            time: Some(0.03),
            digits: &[15.872_485_085_167_984],
        },
        [1e-6, 6e-4],
    ),
    (
        Watched {
            scene: "spinning-top",
            channel: "center",
            unit: "m",
            time: Some(2.0),
            digits: &[],
        },
        [1e-3, 0.04],
    ),
    (
        // the time is on the bump: at the scene's end the wheel is at rest for all steps
        Watched {
            scene: "iltis-suspension",
            channel: "wheel",
            unit: "m",
            time: Some(3.1),
            digits: &[],
        },
        [1e-3, 0.062],
    ),
    (
        // the time is before the blow, when only a spring acts, whose energy every step conserves
        Watched {
            scene: "hammer-blow",
            channel: "angle",
            unit: "rad",
            time: Some(4.0),
            digits: &[0.247_213_592_867_112],
        },
        [1e-3, 0.08],
    ),
];
/// A rule for each tolerance: its name on the command line, its name here, and its style.
type Choice = (fn(f64) -> Rule, &'static str, &'static str, usize);
/// The rules; the estimate is first.
const RULES: [Choice; 3] = [
    (Rule::Error, "error", "estimate", INDEX_3),
    (Rule::Both, "both", "both", MULTI),
    (Rule::Energy, "energy", "energy", INDEX_1),
];
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 3;

/// Runs the experiment on tolerances.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section = Section::new("B", "What a tolerance buys");
    section.words(
        "Index 3 with steps chosen by the estimate of the error of a step, by the change of the energy (refused above the tolerance, \
        lengthened below a hundredth of it), and by both with the same tolerance. The largest step is a fiftieth of the run. \
        Errors at equal time are those of the middle of all tolerances; where times do not meet, the line of the estimate is continued.",
    );
    let mut sights = Vec::new();
    for (watched, steps) in &SCENES {
        section.heading(watched.scene);
        let Some(reference) = watched.reference(lab)? else {
            section.words("No reference could be computed.");
            continue;
        };
        section.words(format!(
            "{} First step {} s, largest {} s.",
            reference.sentence(watched),
            step(steps[0]),
            step(steps[1])
        ));
        let runs = watched.measure(lab, &reference, &cases(watched, *steps, lab.quick), REPEATS)?;
        sights.extend(scene(watched, &reference, &runs, &mut section));
        section.runs.extend(runs);
    }
    sight::report(&sights, &mut section);
    Ok(section)
}

/// Cases for each rule, with tolerances in decreasing order.
fn cases(watched: &Watched, steps: [f64; 2], quick: bool) -> Vec<Case> {
    let halves = if quick { (6..=14).step_by(2) } else { (6..=18).step_by(1) };
    let tolerances: Vec<_> = halves.map(|half| 10_f64.powf(-0.5 * f64::from(half))).collect();
    let each = |(rule, ..): Choice| {
        tolerances
            .iter()
            .map(move |&tolerance| watched.case(rule(tolerance), steps))
            .collect::<Vec<_>>()
    };
    RULES.into_iter().flat_map(each).collect()
}

/// Adds the drawings and all runs of a scene. Returns the evaluation of each rule.
fn scene(
    watched: &Watched,
    reference: &Reference,
    runs: &[Run],
    section: &mut Section,
) -> Vec<Sight> {
    let label = watched.label();
    let line = |control: &str, x: fn(&Run) -> Option<f64>| {
        points(runs.iter().filter(|run| run.case.control() == control), x, |run| run.true_error)
    };
    let tolerance = |run: &Run| run.case.tolerance();
    let estimate = line("error", Run::seconds);
    let sights = RULES.map(|(_, control, name, _)| {
        let over_tolerance = line(control, tolerance);
        Sight::new(watched.scene, name, &over_tolerance, reference.doubt)
            .beside(&line(control, Run::seconds), &estimate)
    });
    let draw = |x: fn(&Run) -> Option<f64>| -> Vec<Series> {
        RULES.map(|(_, control, name, style)| curve(name, style, line(control, x))).to_vec()
    };
    let sentences: Vec<_> = sights.iter().map(Sight::behaviour).collect();
    let caption = format!("True error over tolerance. {}", sentences.join(" "));
    section.figure(&Chart::log_log("tolerance [-]", &label, draw(tolerance)), &caption);
    let sentences: Vec<_> = sights[1..].iter().map(Sight::at_equal_time).collect();
    let caption = format!("True error over CPU time. {}", sentences.join(" "));
    section.figure(&Chart::log_log("CPU [s]", &label, draw(Run::seconds)), &caption);
    let head = [&HEAD[..], &["true error"]].concat();
    let row = |run: &Run| row_with(run, [cell(run.true_error, error)]);
    section.behind("Every run", &head, runs.iter().map(row).collect());
    sights.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn largest_steps_are_a_fiftieth_of_the_run() {
        for (watched, [first, largest]) in SCENES {
            let fiftieth = watched.time.unwrap() / 50.0;
            assert!((largest - fiftieth).abs() < 1e-12 && first < largest, "{}", watched.scene);
        }
    }
}
