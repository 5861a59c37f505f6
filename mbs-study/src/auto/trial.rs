//! Interface between the choice and the runs: the request for a trial, and its result.

use crate::compare::method::MethodCase;
use mbs::record::RunError;

/// Outputs at each instant after the start.
pub(crate) type Rows = Vec<Vec<f64>>;

/// Aim of a trial: which results are recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Outputs at all instants.
    Rows,
    /// Outputs at all instants, and the time of every step.
    Steps,
    /// CPU time of the whole run without recording.
    Time,
}

/// Trial run of the pilot.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Outputs at the instants.
    pub rows: Rows,
    /// CPU time of the trial's steps [s].
    pub seconds: f64,
    /// Number of steps of the run.
    pub steps: u64,
    /// Fraction of the span that was reached [-].
    pub reached: f64,
    /// Time of the slowest step [s], if each step was timed.
    pub slowest: Option<f64>,
    /// End of the trial.
    pub end: TrialEnd,
}

/// End of a trial.
#[derive(Debug, Clone, PartialEq)]
pub enum TrialEnd {
    /// Trial that reached the end of the span.
    Done,
    /// Trial that took longer than its time limit.
    GivenUp,
    /// Run that stopped with this error.
    Stopped(RunError),
    /// Run that did not start; no other setting helps.
    NotStarted(RunError),
}

/// Bench that runs trials. The choice reads time from the bench only, so that any clock can be used.
pub trait Bench {
    /// Runs a method with a setting over the span, for no longer than `limit` [s].
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, limit: f64) -> Trial;

    /// Seconds since the pilot began, by the clock of the trials.
    fn spent(&mut self) -> f64;

    /// Largest distance of outputs at the same instants, relative to the scale of each output in `reference`.
    fn distance(&self, reference: &Rows, rows: &Rows) -> f64;
}
