//! Options of a run that exclude each other.

use super::run::{Run, Watchers};
use crate::erased::SimulationError;
use core::fmt::{self, Display, Formatter};

/// Options of a run that exclude each other, or that another function takes. The code is `settings-refused`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RunConflict {
    /// A goal or an estimate is for `mbs_study::run`.
    Study,
    /// A checkpoint beside a goal: the methods that are tried have none.
    CheckpointAndGoal,
    /// A pace beside a goal.
    PaceAndGoal,
    /// A pace beside a checkpoint.
    PaceAndCheckpoint,
    /// A pace beside an estimate: the runs of an estimate have no pace.
    PaceAndEstimate,
    /// A pace beside observers or outputs in code.
    PaceAndCode,
    /// A checkpoint beside observers or outputs in code, whose state it does not have.
    CheckpointAndCode,
    /// Observers beside a goal: a run that stops is made anew by another method.
    ObserversAndGoal,
    /// A time between checkpoints that is not positive and finite [s].
    Interval(f64),
}

impl RunConflict {
    /// Finds what excludes each other in the options of a run; `n_functions` counts outputs in code.
    ///
    /// # Errors
    /// The first conflict.
    pub(super) fn check(run: &Run, n_functions: usize) -> Result<(), Self> {
        let has_checkpoint = run.resume.is_some() || run.checkpoints.is_some();
        let (is_paced, has_code) = (run.pacing.is_some(), n_functions > 0);
        let rules = [
            (run.goal.is_some() && has_checkpoint, Self::CheckpointAndGoal),
            (run.goal.is_some() && is_paced, Self::PaceAndGoal),
            (is_paced && has_checkpoint, Self::PaceAndCheckpoint),
            (is_paced && run.estimate, Self::PaceAndEstimate),
            (is_paced && has_code, Self::PaceAndCode),
            (has_checkpoint && has_code, Self::CheckpointAndCode),
        ];
        if let Some((_, conflict)) = rules.into_iter().find(|(is_so, _)| *is_so) {
            return Err(conflict);
        }
        run.checkpoints.as_ref().map_or(Ok(()), |(_, every)| Self::check_interval(*every))
    }

    /// Checks the simulated time between two checkpoints [s].
    ///
    /// # Errors
    /// [`Interval`](Self::Interval) for one that is not positive and finite.
    pub fn check_interval(every: f64) -> Result<(), Self> {
        if every > 0.0 && every.is_finite() { Ok(()) } else { Err(Self::Interval(every)) }
    }

    /// Finds what in the options of a run excludes its observers.
    ///
    /// # Errors
    /// The first conflict.
    pub(super) fn check_watchers(run: &Run, watchers: &Watchers<'_, '_>) -> Result<(), Self> {
        if watchers.observers.is_empty() {
            return Ok(());
        }
        let rules = [
            (run.goal.is_some(), Self::ObserversAndGoal),
            (run.pacing.is_some(), Self::PaceAndCode),
            (run.resume.is_some() || run.checkpoints.is_some(), Self::CheckpointAndCode),
        ];
        rules.into_iter().find(|(is_so, _)| *is_so).map_or(Ok(()), |(_, conflict)| Err(conflict))
    }

    /// Hint on what to do.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Study => "call mbs_study::run with the same options, or leave them out",
            Self::Interval(_) => "give simulated seconds, such as --checkpoint 1",
            _ => "leave one of them out",
        }
    }
}

impl Display for RunConflict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Study => "mbs::run takes no goal and no estimate, which need more runs than one",
            Self::CheckpointAndGoal => {
                "a run with checkpoints has one method: none can be chosen for an error or a deadline"
            }
            Self::PaceAndGoal => {
                "a run at the pace of a clock has one method: none can be chosen for an error or a deadline"
            }
            Self::PaceAndCheckpoint => "a run at the pace of a clock has no checkpoints",
            Self::PaceAndEstimate => "a run at the pace of a clock has no estimate of its errors",
            Self::PaceAndCode => {
                "a run at the pace of a clock has no observers and no outputs in code"
            }
            Self::CheckpointAndCode => {
                "a checkpoint has no state of observers and of outputs in code: a run with them cannot be resumed"
            }
            Self::ObserversAndGoal => {
                "a run for an error or a deadline may be made by several methods: it has no observers"
            }
            Self::Interval(every) => {
                return write!(
                    f,
                    "the time between checkpoints must be positive and finite, but is {every}"
                );
            }
        })
    }
}

impl core::error::Error for RunConflict {}

impl From<RunConflict> for SimulationError {
    fn from(conflict: RunConflict) -> Self {
        Self::new("settings-refused", conflict, conflict.hint()).with_cause(conflict)
    }
}
