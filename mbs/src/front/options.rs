//! Options of a run as data, and who watches it.

use crate::checkpoint::Checkpoint;
use crate::erased::input_table::InputTable;
use crate::erased::view::Observer;
use crate::settings::Method;
use core::fmt::{self, Debug, Formatter};
use mbs_steps::realtime::{Clock, Pacing};
use mbs_steps::recorder::RecordRows;
use std::path::{Path, PathBuf};

/// Requirement on a run: mbs-study chooses formulation, integrator and step for it by a pilot.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Goal {
    /// Largest error of the outputs over the run, each relative to its range [-], as `mbs compare` takes it.
    pub error: Option<f64>,
    /// Length of the frames in which the run is made [s]; each is computed within the same time.
    pub deadline: Option<f64>,
}

impl Goal {
    /// Requires an error of the outputs, relative to their ranges [-].
    #[must_use]
    pub fn error(error: f64) -> Self {
        Self { error: Some(error), deadline: None }
    }

    /// Requires that each frame of this length [s] is computed within the same time.
    #[must_use]
    pub fn deadline(frame: f64) -> Self {
        Self { error: None, deadline: Some(frame) }
    }

    /// Is an error or a deadline required?
    #[must_use]
    pub fn is_some(&self) -> bool {
        self.error.is_some() || self.deadline.is_some()
    }
}

/// Options of a run, as data: `mbs run`, `Mechanism.run` of Python and `mbs_study::run` make the same of them.
///
/// [`run`](crate::run) takes all but a goal and an estimate, which need more runs than one: those are for `mbs_study::run`.
#[derive(Debug, Clone, Default)]
pub struct Run {
    /// Method by which the mechanism is stepped; what it leaves open is the mechanism's.
    pub method: Method,
    /// Required error or deadline, for which the method is chosen.
    pub goal: Goal,
    /// Table that inputs of the mechanism follow; the others keep their start.
    pub inputs: Option<InputTable>,
    /// Checkpoint to resume from, with the method of its run.
    pub resume: Option<Checkpoint>,
    /// Folder of checkpoints, and the simulated time between two of them [s].
    pub checkpoints: Option<(PathBuf, f64)>,
    /// Pace of a run that follows a clock.
    pub pacing: Option<Pacing>,
    /// Whether the errors of the outputs are estimated after the run, and a method that runs is sought where it stops. Beside a goal nothing is
    /// estimated: its pilot states what it measured.
    pub estimate: bool,
    /// Whether the last row alone is kept; statistics are those of all rows.
    pub last_row_alone: bool,
}

impl Run {
    /// A run as the mechanism asks for it.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the method of the run. A [`duration`](Self::duration) that was given stays where the method has none.
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        let duration = method.duration.or(self.method.duration);
        Self { method: Method { duration, ..method }, ..self }
    }

    /// Sets the duration [s], in place of the mechanism's; left out in both, 1 s.
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

    /// Lets inputs follow a table.
    #[must_use]
    pub fn inputs(self, table: InputTable) -> Self {
        Self { inputs: Some(table), ..self }
    }

    /// Resumes from a checkpoint. Settings that are given must be those of its run, but for the number of threads.
    #[must_use]
    pub fn resume(self, checkpoint: Checkpoint) -> Self {
        Self { resume: Some(checkpoint), ..self }
    }

    /// Keeps checkpoints in a folder, each `every` [s] of simulated time. The last one stays there, and the first of the next run replaces it:
    /// look for it before, and [`resume`](Self::resume) from it. [`RunResult::checkpoints`](crate::RunResult::checkpoints) says what could not be written.
    #[must_use]
    pub fn checkpoints(self, folder: impl AsRef<Path>, every: f64) -> Self {
        Self { checkpoints: Some((folder.as_ref().to_owned(), every)), ..self }
    }

    /// Runs at the pace of a clock, by default that of the system. A paced run reports no progress.
    #[must_use]
    pub fn pacing(self, pacing: Pacing) -> Self {
        Self { pacing: Some(pacing), ..self }
    }

    /// Estimates the errors of the outputs after the run.
    #[must_use]
    pub fn estimate(self) -> Self {
        Self { estimate: true, ..self }
    }

    /// Keeps the last row alone.
    #[must_use]
    pub fn last_row_alone(self) -> Self {
        Self { last_row_alone: true, ..self }
    }

    pub(super) fn keep(&self) -> RecordRows {
        if self.last_row_alone { RecordRows::Last } else { RecordRows::All }
    }
}

/// Observers of a run, a listener to its progress, and the clock of a paced one.
#[derive(Default)]
pub struct Watchers<'a, 'b> {
    /// Observers: they set inputs on the way, read the mechanism after each step, and may end the run.
    pub observers: &'a mut [&'b mut dyn Observer],
    /// Listener that receives the time of each step [s].
    pub progress: Option<&'a mut dyn FnMut(f64)>,
    /// Clock of a paced run; that of the system if none is given.
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

    /// Makes watchers of observers alone.
    pub fn observers(observers: &'a mut [&'b mut dyn Observer]) -> Self {
        Self { observers, progress: None, clock: None }
    }

    /// Makes watchers of a listener alone.
    pub fn progress(listener: &'a mut dyn FnMut(f64)) -> Self {
        Self { observers: &mut [], progress: Some(listener), clock: None }
    }

    /// Makes watchers of a clock alone.
    pub fn clock(clock: &'a mut dyn Clock) -> Self {
        Self { observers: &mut [], progress: None, clock: Some(clock) }
    }
}
