//! Experiment on the double pendulum of the report's second publication: its Figures 2 to 5, 7 and 8, and the cost of each rule of the
//! steps.

use super::draw::{ALONE, INDEX_3, MULTI, line, over_time, steps, work_precision};
use super::fit::{between, median, rank_correlation, span};
use super::rows::{HEAD, row};
use crate::chart::Kind;
use crate::format::{error, ratio};
use crate::lab::case::{Case, Rule, size};
use crate::lab::record::{Record, Step};
use crate::lab::section::Section;
use crate::lab::{Lab, Run};
use std::collections::BTreeMap;

/// Scene of the experiment.
const SCENE: &str = "double-pendulum";
/// Output of the acceleration of the tip, which the scene does not have.
const ACCELERATION: &str = "\n[[output]]\nname = \"tip-acceleration\"\nbody = \"lower\"\nat = [2.0, 0.0]\nquantity = \"acceleration\"\n";
/// Column of the vertical component of that acceleration.
const COLUMN: &str = "tip-acceleration.y";
/// The fixed step with which the controlled run is compared [s].
const FIXED: f64 = 1e-3;
/// First and largest step of controlled runs [s].
const STEPS: [f64; 2] = [1e-3, 1e-2];
/// Tolerances of the drawn histories: the publication's usual one, and one with short steps.
const TOLERANCES: [f64; 2] = [1e-5, 1e-8];
/// Number of runs of each case, for its least time.
const REPEATS: u32 = 3;

/// Runs the experiment on the double pendulum.
pub(crate) fn run(lab: &Lab<'_>) -> Result<Section, String> {
    let mut section =
        Section::new("P2", "Double pendulum: energy as a measure of the error of a step");
    section.words(
        "Two rods fall from the horizontal for 10 s (publication 2, Figures 2 to 5, 7 and 8). It proposes the energy of the penalty \
        system, and then the change of the energy invariant within a step, as measures of the error of a step, because both grow \
        where the acceleration does.",
    );
    let with = |case: Case| Case { appended: ACCELERATION, ..case };
    let fixed = lab.record(&with(Case::fixed(SCENE, "index-3", FIXED)), &[COLUMN])?;
    let fixed = fixed.unwrap_or_default();
    measures(&fixed, &mut section);
    let variable = TOLERANCES.map(|tolerance| {
        let case = Case::variable(SCENE, "multi-index", Rule::Energy(tolerance), STEPS);
        Ok::<_, String>(lab.record(&case, &[])?.unwrap_or_default())
    });
    let [usual, tight] = variable;
    beside(&fixed, &[usual?, tight?], &mut section);
    work(lab, &mut section)?;
    Ok(section)
}

/// A drawing of the fixed step: label, spacing of the axis, value of each step, and caption.
type Measure = (&'static str, Kind, fn(&Step) -> f64, &'static str);

/// Figures 3 to 5.
const MEASURES: [Measure; 3] = [
    (
        "penalty energy [J]",
        Kind::Log,
        |s| s.penalty_energy,
        "Energy of the penalty system (Figure 3).",
    ),
    ("energy [J]", Kind::Linear, |s| s.energy_error, "Total energy, zero at the start (Figure 4)."),
    (
        "change of energy [J]",
        Kind::Log,
        |s| s.energy_change.abs(),
        "Change of the energy within each step, absolute (Figure 5).",
    ),
];

/// Draws Figures 2 to 5, with the fixed step.
fn measures(record: &Record, section: &mut Section) {
    section.heading(format!("Index 3 at a fixed step of {FIXED:e} s"));
    let acceleration = record.channels.first().cloned().unwrap_or_default();
    let at: BTreeMap<u64, f64> = acceleration.iter().map(|[t, a]| (t.to_bits(), a.abs())).collect();
    let most = acceleration.iter().map(|[t, a]| [a.abs(), *t]).max_by(|a, b| a[0].total_cmp(&b[0]));
    let peak = peak_sentence(most);
    let mut draw = |label: &str, kind, points, caption: String| {
        let series = vec![line("index-3, fixed", ALONE, points)];
        section.figure(&over_time(label, kind, series), &caption);
    };
    let caption = format!("Vertical acceleration of the tip (Figure 2).{peak}");
    draw("acceleration [m/s²]", Kind::Linear, acceleration, caption);
    for (label, kind, number, what) in MEASURES {
        let beside = |s: &Step| Some([*at.get(&s.t.to_bits())?, number(s).abs()]);
        let pairs: Vec<_> = record.steps.iter().filter_map(beside).collect();
        let ranks = rank_correlation(&pairs).map_or(String::new(), |r| {
            format!(" Ranked by size it goes with the acceleration at a correlation of {r:.2}.")
        });
        draw(label, kind, record.points(number), format!("{what}{ranks}"));
    }
    let both = |s: &Step| [s.penalty_energy, s.energy_change.abs()];
    let pairs: Vec<_> = record.steps.iter().map(both).collect();
    if let Some(r) = rank_correlation(&pairs) {
        section.words(format!(
            "Penalty energy and change of energy go together at a correlation of {r:.2} of their ranks."
        ));
    }
}

/// Sentence with the largest magnitude of the acceleration and its time.
fn peak_sentence(most: Option<[f64; 2]>) -> String {
    most.map_or(String::new(), |[a, t]| format!(" Its largest amount is {a:.0} m/s² at {t:.2} s."))
}

/// Draws Figures 7 and 8: the controlled runs, and the fixed step.
fn beside(fixed: &Record, variable: &[Record; 2], section: &mut Section) {
    section.heading("Steps and index of its own");
    for (record, tolerance) in variable.iter().zip(TOLERANCES) {
        let n_1 = record.steps.iter().filter(|s| s.is_index_1).count();
        let [least, most] = span(record.steps.iter().map(|s| s.step)).unwrap_or_default();
        let name = format!("multi-index, tolerance {tolerance:e}");
        section.figure(
            &over_time("step [s]", Kind::Log, steps(record, &name, MULTI)),
            &format!(
                "Steps and index (Figure 7) at a tolerance of {tolerance:e}: {} to {} s, {n_1} of {} recorded steps in index 1.",
                size(least),
                size(most),
                record.steps.len()
            ),
        );
    }
    let worst = |record: &Record| span(record.steps.iter().map(|s| s.energy_error.abs()));
    let errors = [fixed, &variable[0], &variable[1]].map(|record| {
        worst(record).map_or("unknown".to_owned(), |[_, most]| format!("{} J", error(most)))
    });
    let series = vec![
        line(format!("index-3, fixed {FIXED:e} s"), INDEX_3, fixed.points(|s| s.energy_error)),
        line(
            format!("multi-index, tolerance {:e}", TOLERANCES[0]),
            MULTI,
            variable[0].points(|s| s.energy_error),
        ),
    ];
    section.figure(
        &over_time("energy [J]", Kind::Linear, series),
        &format!(
            "Total energy, zero at the start (Figure 8). Its largest recorded error is {} with the fixed step, {} with the first \
            tolerance and {} with the second.",
            errors[0], errors[1], errors[2]
        ),
    );
}

/// Measures the largest energy error and CPU time of all rules.
fn work(lab: &Lab<'_>, section: &mut Section) -> Result<(), String> {
    section.heading("What it costs");
    let finest = if lab.quick { 6 } else { 9 };
    let mut cases = Vec::new();
    for formulation in ["index-3", "index-1"] {
        cases.extend((0..=finest).map(|k| Case::fixed(SCENE, formulation, 1e-2 / 2_f64.powi(k))));
    }
    let tightest = if lab.quick { 7 } else { 9 };
    cases.extend(
        (4..=tightest)
            .map(|k| Case::variable(SCENE, "multi-index", Rule::Energy(10_f64.powi(-k)), STEPS)),
    );
    let runs = lab.measure(&cases, REPEATS)?;
    section.behind("Every run", &HEAD, runs.iter().map(row).collect());
    let of = |formulation: &str| {
        let runs = runs.iter().filter(|run| run.case.formulation == formulation);
        runs.filter_map(|run| Some([run.energy_error()?, run.seconds()?])).collect::<Vec<_>>()
    };
    let (ours, fixed) = (of("multi-index"), of("index-3"));
    let ratios: Vec<f64> =
        ours.iter().filter_map(|[e, s]| Some(s / between(&fixed, *e)?)).collect();
    let worst = ratios.iter().copied().fold(0.0, f64::max);
    let compared = median(ratios).map_or(String::new(), |r| {
        section.claim(
            format!("{SCENE}: at equal energy error at most the time of fixed steps in index 3"),
            format!("ratio {} in the middle of all tolerances, {} at most", ratio(r), ratio(worst)),
            Some(worst <= 1.0),
        );
        format!(" At equal error the variable steps take {} of the time of fixed steps in index 3 (the middle of all tolerances).", ratio(r))
    });
    section.figure(
        &work_precision(&runs, "largest energy error [J]", Run::energy_error),
        &format!("Largest energy error over CPU time: lower and further left is better.{compared}"),
    );
    section.runs.extend(runs);
    Ok(())
}
