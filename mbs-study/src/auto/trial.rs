//! Border between choosing, which is counted and compared, and running: the request for a trial, and its result.

use crate::compare::method::MethodCase;
use mbs::record::RunError;

/// Outputs at the instants after the start.
pub(crate) type Rows = Vec<Vec<f64>>;

/// Aim of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aim {
    /// Outputs at all instants.
    Rows,
    /// Outputs at all instants, and the time of every step.
    Steps,
    /// The time of the whole, as it is without recording.
    Time,
}

/// A run of the pilot.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Outputs at the instants.
    pub rows: Rows,
    /// CPU time of its steps [s].
    pub seconds: f64,
    /// Number of steps of the run.
    pub steps: u64,
    /// Fraction of the span that was reached.
    pub reached: f64,
    /// The slowest step [s], where each was timed.
    pub slowest: Option<f64>,
    /// End of the trial.
    pub end: TrialEnd,
}

/// End of a trial.
#[derive(Debug, Clone, PartialEq)]
pub enum TrialEnd {
    /// At the end of the span.
    Done,
    /// Trial that took longer than it was given.
    GivenUp,
    /// Run that stopped with this error.
    Stopped(RunError),
    /// Run that did not start: no setting helps.
    NotStarted(RunError),
}

/// Bench that runs trials. Whoever chooses knows time by this only, so that a choice can be made on any clock.
pub trait Bench {
    /// Runs the span with a setting, for no longer than `limit` [s].
    fn trial(&mut self, method: &MethodCase, setting: f64, aim: Aim, limit: f64) -> Trial;

    /// Seconds since the pilot began, by the clock of the trials.
    fn spent(&mut self) -> f64;

    /// Largest distance of outputs at the same instants, each in its scale over the first.
    fn distance(&self, reference: &Rows, rows: &Rows) -> f64;
}
