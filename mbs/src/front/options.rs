//! Options of a run as data, and the observers of a run.

use crate::checkpoint::Checkpoint;
use crate::erased::input_table::InputTable;
use crate::erased::view::Observer;
use crate::settings::Method;
use core::fmt::{self, Debug, Formatter};
use mbs_steps::realtime::{Clock, Pacing};
use mbs_steps::recorder::RecordRows;
use std::path::{Path, PathBuf};

/// Requirement on a run. mbs-study chooses formulation, integrator and step for the requirement by short trial runs.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Goal {
    /// Largest error of the outputs over the run, as `mbs compare` measures it. The error of each output is relative to the range of that
    /// output [-].
    pub error: Option<f64>,
    /// Length of a frame [s]. The steps of each frame must be computed in at most this time.
    pub deadline: Option<f64>,
}

impl Goal {
    /// Requires that the outputs have at most this error, relative to their ranges [-].
    #[must_use]
    pub fn error(error: f64) -> Self {
        Self { error: Some(error), deadline: None }
    }

    /// Requires that the steps of each frame of this length [s] are computed in at most this time.
    #[must_use]
    pub fn deadline(frame: f64) -> Self {
        Self { error: None, deadline: Some(frame) }
    }

    /// True if an error or a deadline is required.
    #[must_use]
    pub fn is_some(&self) -> bool {
        self.error.is_some() || self.deadline.is_some()
    }
}

/// Options of a run as data, which `mbs run`, `Mechanism.run` of Python and `mbs_study::run` interpret in the same way.
///
/// [`run`](crate::run) refuses a goal and an estimate, because they need several runs. Use `mbs_study::run` for them.
#[derive(Debug, Clone, Default)]
pub struct Run {
    /// Method of the run. Settings that it leaves open are taken from the mechanism.
    pub method: Method,
    /// Required error or deadline, for which the method is chosen.
    pub goal: Goal,
    /// Table that inputs of the mechanism follow. Inputs without a column in the table keep their start value.
    pub inputs: Option<InputTable>,
    /// Checkpoint to resume from. The run uses the method of the checkpoint.
    pub resume: Option<Checkpoint>,
    /// Folder of checkpoints, and the simulated time between two of them [s].
    pub checkpoints: Option<(PathBuf, f64)>,
    /// Pacing of a run that is synchronised with a clock.
    pub pacing: Option<Pacing>,
    /// Whether the errors of the outputs are estimated after the run. If the run stops early, another method that completes is searched.
    /// Together with a goal nothing is estimated, because the goal's trial runs already give the errors.
    pub estimate: bool,
    /// Whether only the last row is recorded. Statistics of the outputs cover all rows nevertheless.
    pub last_row_alone: bool,
}

impl Run {
    /// Makes options that leave all settings to the mechanism.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the method of the run. A [`duration`](Self::duration) that was set before stays, unless the method sets a duration too.
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        let duration = method.duration.or(self.method.duration);
        Self { method: Method { duration, ..method }, ..self }
    }

    /// Sets the duration [s], in place of the mechanism's. Default, where the mechanism has none: 1 s.
    #[must_use]
    pub fn duration(mut self, duration: f64) -> Self {
        self.method.duration = Some(duration);
        self
    }

    /// Requires an error or a deadline, or both.
    #[must_use]
    pub fn goal(self, goal: Goal) -> Self {
        Self { goal, ..self }
    }

    /// Sets the table that inputs of the mechanism follow.
    #[must_use]
    pub fn inputs(self, table: InputTable) -> Self {
        Self { inputs: Some(table), ..self }
    }

    /// Resumes from a checkpoint. Settings that are given must equal those of the checkpoint's run, except the number of threads.
    #[must_use]
    pub fn resume(self, checkpoint: Checkpoint) -> Self {
        Self { resume: Some(checkpoint), ..self }
    }

    /// Writes checkpoints into a folder, one each `every` [s] of simulated time. The folder keeps the last checkpoint until the next run
    /// writes its first one there. To [`resume`](Self::resume), read the checkpoint before that run begins.
    /// [`RunResult::checkpoints`](crate::RunResult::checkpoints) reports checkpoints that could not be written.
    #[must_use]
    pub fn checkpoints(self, folder: impl AsRef<Path>, every: f64) -> Self {
        Self { checkpoints: Some((folder.as_ref().to_owned(), every)), ..self }
    }

    /// Synchronises the run with a clock; default: the system's clock. Such a run reports no progress.
    #[must_use]
    pub fn pacing(self, pacing: Pacing) -> Self {
        Self { pacing: Some(pacing), ..self }
    }

    /// Estimates the errors of the outputs after the run.
    #[must_use]
    pub fn estimate(self) -> Self {
        Self { estimate: true, ..self }
    }

    /// Records only the last row.
    #[must_use]
    pub fn last_row_alone(self) -> Self {
        Self { last_row_alone: true, ..self }
    }

    pub(super) fn keep(&self) -> RecordRows {
        if self.last_row_alone { RecordRows::Last } else { RecordRows::All }
    }
}

/// Observers of a run, a listener to its progress, and the clock of a run with pacing.
#[derive(Default)]
pub struct Watchers<'a, 'b> {
    /// Observers of the run. An observer can set inputs, read the mechanism after each step, and end the run.
    pub observers: &'a mut [&'b mut dyn Observer],
    /// Listener that receives the time of each step [s].
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Clock of a run with pacing. Default: the system's clock.
    pub clock: Option<&'a mut dyn Clock>,
}

impl Debug for Watchers<'_, '_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "Watchers of {} observers", self.observers.len())
    }
}

impl<'a, 'b> Watchers<'a, 'b> {
    /// Watchers that do nothing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a listener to the progress.
    #[must_use]
    pub fn with_progress(self, listener: &'a mut dyn FnMut(f64)) -> Self {
        Self { progress: Some(listener), ..self }
    }

    /// Makes watchers that are observers only.
    pub fn observers(observers: &'a mut [&'b mut dyn Observer]) -> Self {
        Self { observers, progress: None, clock: None }
    }

    /// Makes watchers that are a progress listener only.
    pub fn progress(listener: &'a mut dyn FnMut(f64)) -> Self {
        Self { observers: &mut [], progress: Some(listener), clock: None }
    }

    /// Makes watchers that are a clock only.
    pub fn clock(clock: &'a mut dyn Clock) -> Self {
        Self { observers: &mut [], progress: None, clock: Some(clock) }
    }
}
