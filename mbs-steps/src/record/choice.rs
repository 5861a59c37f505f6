//! Evidence of a choice by measurement: the candidates, the results of the pilot for each, and the chosen one.

use super::alias;
use mbs_scene::format::{duration, few, rounded, shortest, significant};
use serde::Serialize;
use std::io;

/// Evidence of a choice by measurement.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct PilotReport {
    /// Required error of the outputs, relative to the scale of each output.
    pub error: Option<f64>,
    /// Time limit for the computation of one frame that has this length [s].
    pub deadline: Option<f64>,
    /// Sentences that describe the structure of the scene.
    pub structure: Vec<String>,
    /// Duration of the motion that the pilot simulated [s].
    pub span: f64,
    /// Number of instants at which errors were evaluated.
    pub instants: usize,
    /// CPU time used by the pilot [s].
    pub pilot_seconds: f64,
    /// Largest CPU time allowed for the pilot [s].
    pub pilot_budget: f64,
    /// Reference solution with which errors are computed, and its accuracy.
    pub reference: Option<PilotReference>,
    /// Comparison of the chosen candidate with index-3, if the chosen candidate is in relative coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_look: Option<SecondLook>,
    /// All candidates, with the chosen candidate first. The others follow in the order of predicted CPU time, and rejected candidates are
    /// last.
    pub candidates: Vec<Candidate>,
    /// Candidates that were chosen first, but stopped in the run.
    pub fallbacks: Vec<Fallback>,
    /// Notes for the reader.
    pub notes: Vec<String>,
}

/// Comparison of the chosen candidate with a candidate in other coordinates, whose model is independent of the first.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct SecondLook {
    /// Largest difference of the outputs, relative to the scale of each output.
    pub distance: Option<f64>,
    /// Error of the run in other coordinates, relative to the scale of each output.
    pub own_error: Option<f64>,
    /// True if the distance is larger than the errors of both runs can explain, so that the models differ.
    pub differs: bool,
}

/// Most accurate run of the pilot, to which other runs are compared.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct PilotReference {
    /// Name of the candidate that ran.
    pub method: String,
    /// Step [s] or tolerance of this run.
    pub setting: f64,
    /// Error of the reference. It is estimated by the distance from the run with the next coarser setting.
    pub uncertainty: f64,
}

/// Candidate method for the run of the scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Candidate {
    /// Rank of the candidate, 1 for the chosen one; `None` for a rejected candidate.
    pub rank: Option<usize>,
    /// Name of the candidate: formulation, integrator, step control and precision.
    pub method: String,
    /// Formulation of the candidate.
    pub formulation: String,
    /// Integrator of the candidate.
    pub integrator: String,
    /// Step control: `fixed`, `error` or `energy`; `own` for an integrator that controls its internal steps.
    pub control: String,
    /// Step [s] or tolerance with which the candidate reaches the required error.
    pub setting: Option<f64>,
    /// Predicted CPU time of the whole run [s].
    pub seconds: Option<f64>,
    /// Predicted CPU time divided by the predicted CPU time of the chosen candidate [-].
    #[serde(flatten, serialize_with = "alias::over_chosen")]
    pub over_chosen: Option<f64>,
    /// Predicted error of the run.
    pub error: Option<f64>,
    /// Longest CPU time of a step in the trials of the candidate [s], if steps were timed individually.
    pub slowest_step: Option<f64>,
    /// Text that says what the prediction is based on.
    #[serde(flatten, serialize_with = "alias::basis")]
    pub basis: String,
    /// Reason why the candidate is rejected.
    #[serde(flatten, serialize_with = "alias::out")]
    pub out: Option<String>,
    /// Trials of the candidate with their measurements.
    pub trials: Vec<TrialEntry>,
}

/// Trial of the pilot: one run of a candidate.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct TrialEntry {
    /// Step [s] or tolerance of the trial.
    pub setting: f64,
    /// CPU time of the trial [s].
    pub seconds: f64,
    /// Number of steps in the trial.
    pub steps: u64,
    /// Fraction of the pilot's duration that the trial reached [-].
    pub reached: f64,
    /// Error relative to the reference, or relative to the next trial of the same candidate.
    pub error: Option<f64>,
    /// Outcome of the trial: `completed`, `given up`, or the code of the error that stopped it.
    pub outcome: String,
}

/// Candidate that was chosen and stopped in the run.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Fallback {
    /// Name of the candidate that stopped.
    pub method: String,
    /// Code of the error that stopped it.
    pub code: String,
    /// Message of the error that stopped it.
    pub message: String,
    /// Time of the stop [s].
    pub time: f64,
    /// CPU time of the stopped run [s].
    pub cpu_seconds: f64,
}

/// Column titles of the table of candidates.
const HEAD: [&str; 6] = ["", "candidate", "step or tolerance", "CPU time", "error", "why"];

impl PilotReport {
    /// Returns the reasons for the choice, one sentence each.
    #[must_use]
    pub fn reasons(&self) -> Vec<String> {
        let choice = self;
        let mut reasons = Vec::new();
        let placed = || choice.candidates.iter().filter(|c| c.rank.is_some());
        let Some(first) = placed().next() else {
            return vec!["nothing was left to choose".to_owned()];
        };
        let number = |x: Option<f64>| x.map_or_else(|| "?".to_owned(), few);
        let seconds = |c: &Candidate| c.seconds.map_or_else(|| "?".to_owned(), duration);
        let setting = |c: &Candidate| match c.control.as_str() {
            "fixed" => format!("steps of {} s", number(c.setting)),
            _ => format!("a tolerance of {}", number(c.setting)),
        };
        let required = match (choice.error, choice.deadline) {
            (Some(error), Some(deadline)) => {
                format!("for an error of {} in frames of {} s", few(error), few(deadline))
            }
            (Some(error), None) => format!("for an error of {}", few(error)),
            _ => "as asked".to_owned(),
        };
        reasons.push(format!(
            "{required}: {} with {} takes about {} of CPU time with an error of {} ({})",
            first.method,
            setting(first),
            seconds(first),
            number(first.error),
            first.basis
        ));
        if let (Some(deadline), Some(slowest)) = (choice.deadline, first.slowest_step) {
            let steps = (deadline / first.setting.unwrap_or(deadline)).round();
            reasons.push(format!(
                "{} steps a frame, the slowest of {}: at most {} of the {} that a frame has",
                few(steps),
                duration(slowest),
                duration(steps * slowest),
                duration(deadline)
            ));
        }
        let others = placed()
            .skip(1)
            .filter(|c| c.over_chosen < Some(f64::INFINITY) && c.error <= choice.error);
        let others: Vec<String> = others
            .map(|c| format!("{} {:.2} times as long", c.method, c.over_chosen.unwrap_or(f64::NAN)))
            .collect();
        if !others.is_empty() {
            reasons.push(format!("the others: {}", others.join(", ")));
        }
        let trials: usize = choice.candidates.iter().map(|c| c.trials.len()).sum();
        reasons.push(format!(
            "{trials} trials over the first {} s at {} instants took {}",
            few(choice.span),
            choice.instants,
            duration(choice.pilot_seconds)
        ));
        reasons.extend(choice.second_look.as_ref().map(second_look));
        reasons.extend(choice.notes.iter().cloned());
        reasons.extend(choice.fallbacks.iter().map(fallback));
        reasons
    }

    /// Table of the candidates, with its header row first.
    #[must_use]
    pub fn table(&self) -> Vec<Vec<String>> {
        let number = |x: Option<f64>, unit: &str| {
            x.map_or_else(|| "-".to_owned(), |x| format!("{}{unit}", significant(rounded(x, 3))))
        };
        let row = |c: &Candidate| {
            let why = match (&c.out, c.over_chosen) {
                (Some(why), _) => why.clone(),
                (None, Some(times)) if c.rank != Some(1) => {
                    format!("{times:.2} times the chosen one; {}", c.basis)
                }
                _ => c.basis.clone(),
            };
            vec![
                c.rank.map_or_else(|| "out".to_owned(), |rank| rank.to_string()),
                c.method.clone(),
                number(c.setting, if c.control == "fixed" { " s" } else { "" }),
                number(c.seconds, " s"),
                c.error.map_or_else(|| "-".to_owned(), |e| format!("{e:.1e}")),
                why,
            ]
        };
        let head = HEAD.map(str::to_owned).to_vec();
        core::iter::once(head).chain(self.candidates.iter().map(row)).collect()
    }
}

const COLUMNS: [&str; 14] = [
    "rank",
    "method",
    "formulation",
    "integrator",
    "control",
    "setting",
    "predicted_cpu_seconds",
    "predicted_error",
    "out",
    "trial_setting",
    "trial_cpu_seconds",
    "trial_reached",
    "trial_error",
    "trial_outcome",
];

/// Writes one row for each trial of each candidate; a candidate without trials has one row.
///
/// # Errors
/// The errors of the sink.
pub fn write_choice(sink: impl io::Write, choice: &PilotReport) -> io::Result<()> {
    let mut out = csv::Writer::from_writer(sink);
    out.write_record(COLUMNS)?;
    let number = |x: Option<f64>| x.map(shortest).unwrap_or_default();
    for c in &choice.candidates {
        let of_candidate = [
            c.rank.map(|rank| rank.to_string()).unwrap_or_default(),
            c.method.clone(),
            c.formulation.clone(),
            c.integrator.clone(),
            c.control.clone(),
            number(c.setting),
            number(c.seconds),
            number(c.error),
            c.out.clone().unwrap_or_default(),
        ];
        let of_trial = |t: &TrialEntry| {
            let numbers = [Some(t.setting), Some(t.seconds), Some(t.reached), t.error].map(number);
            numbers.into_iter().chain([t.outcome.clone()])
        };
        if c.trials.is_empty() {
            let none = core::iter::repeat_n(String::new(), COLUMNS.len() - of_candidate.len());
            out.write_record(of_candidate.iter().cloned().chain(none))?;
        }
        for trial in &c.trials {
            out.write_record(of_candidate.iter().cloned().chain(of_trial(trial)))?;
        }
    }
    out.flush()
}

/// Describes the distance between the outputs of two models: that of the chosen candidate and another one.
fn second_look(look: &SecondLook) -> String {
    let distance = look.distance.map_or_else(|| "?".to_owned(), few);
    let own = look.own_error.map_or_else(
        || "but nothing is known of its own error".to_owned(),
        |error| format!("and errs by {} itself", few(error)),
    );
    format!("index-3, which shares no model with it, differs by {distance}, {own}")
}

/// Describes a candidate that stopped in the run.
fn fallback(lost: &Fallback) -> String {
    format!(
        "{} came before and stopped at {} s: {} ({}); {} of CPU time lost",
        lost.method,
        few(lost.time),
        lost.message,
        lost.code,
        duration(lost.cpu_seconds)
    )
}
