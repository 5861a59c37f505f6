//! Options of a run that exclude each other.

use super::options::{Run, Watchers};
use crate::erased::SimulationError;
use core::fmt::{self, Display, Formatter};

/// Conflict of the options of a run: two of them exclude each other, or one needs `mbs_study::run`. The error code is `settings-refused`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RunConflict {
    /// A goal or an estimate was given: only `mbs_study::run` makes such runs.
    Study,
    /// Two parts of a run exclude each other.
    Together {
        /// Parts that exclude each other.
        parts: [&'static str; 2],
        /// Reason why they exclude each other.
        why: &'static str,
    },
    /// A time between checkpoints that is not positive and finite [s].
    Interval(f64),
}

/// Names of the options of a run in messages.
const GOAL: &str = "a required error or deadline";
const CHECKPOINTS: &str = "checkpoints";
const PACE: &str = "the pace of a clock";
const ESTIMATE: &str = "an estimate of the errors";
const OBSERVERS: &str = "observers";
const FUNCTIONS: &str = "outputs in code";
const LAST_ROW: &str = "the last row alone";

impl RunConflict {
    /// Checks that no two options of a run exclude each other. `n_functions` is the number of outputs that are written in code.
    ///
    /// # Errors
    /// The first conflict.
    pub(super) fn check(run: &Run, n_functions: usize) -> Result<(), Self> {
        let has_goal = run.goal.is_some();
        let is_kept = run.resume.is_some() || run.checkpoints.is_some();
        let (is_paced, is_estimated) = (run.pacing.is_some(), run.estimate);
        let (has_functions, is_last) = (n_functions > 0, run.last_row_alone);
        first([
            (has_goal && is_kept, [GOAL, CHECKPOINTS], "they are of one method"),
            (has_goal && is_paced, [GOAL, PACE], "a paced run has one method"),
            (is_paced && is_kept, [PACE, CHECKPOINTS], "a paced run has none"),
            (is_paced && is_estimated, [PACE, ESTIMATE], "the runs of an estimate have no pace"),
            (is_paced && has_functions, [PACE, FUNCTIONS], "a paced run has no columns of code"),
            (
                is_kept && has_functions,
                [CHECKPOINTS, FUNCTIONS],
                "a checkpoint has not their state",
            ),
            (is_last && is_paced, [LAST_ROW, PACE], "a paced run keeps all rows"),
            (is_last && is_estimated, [LAST_ROW, ESTIMATE], "an estimate compares rows"),
            (is_last && is_kept, [LAST_ROW, CHECKPOINTS], "a checkpoint has all rows"),
        ])?;
        run.checkpoints.as_ref().map_or(Ok(()), |(_, every)| Self::check_interval(*every))
    }

    /// Checks that the options of a run allow its observers.
    ///
    /// # Errors
    /// The first conflict.
    pub(super) fn check_watchers(run: &Run, watchers: &Watchers<'_, '_>) -> Result<(), Self> {
        if watchers.observers.is_empty() {
            return Ok(());
        }
        let is_kept = run.resume.is_some() || run.checkpoints.is_some();
        first([
            (run.goal.is_some(), [OBSERVERS, GOAL], "several methods may run"),
            (run.estimate, [OBSERVERS, ESTIMATE], "the runs of an estimate have none"),
            (run.pacing.is_some(), [OBSERVERS, PACE], "a paced run has none"),
            (is_kept, [OBSERVERS, CHECKPOINTS], "a checkpoint has not their state"),
        ])
    }

    /// Checks the simulated time between two checkpoints [s].
    ///
    /// # Errors
    /// [`Interval`](Self::Interval) for a time that is not positive and finite.
    pub fn check_interval(every: f64) -> Result<(), Self> {
        if every > 0.0 && every.is_finite() { Ok(()) } else { Err(Self::Interval(every)) }
    }

    /// Hint on what to do.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Study => "call mbs_study::run with the same options, or leave them out",
            Self::Together { .. } => "leave one of them out",
            Self::Interval(_) => "give simulated seconds, such as 1",
        }
    }
}

/// Returns an error for the first rule whose condition is true. A rule is a condition, two options and the reason why they exclude each
/// other.
fn first<const N: usize>(
    rules: [(bool, [&'static str; 2], &'static str); N],
) -> Result<(), RunConflict> {
    let found = rules.into_iter().find(|(is_so, ..)| *is_so);
    found.map_or(Ok(()), |(_, parts, why)| Err(RunConflict::Together { parts, why }))
}

impl Display for RunConflict {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Study => {
                f.write_str("mbs::run takes no goal and no estimate, which need more runs than one")
            }
            Self::Together { parts: [a, b], why } => {
                write!(f, "{a} and {b} exclude each other: {why}")
            }
            Self::Interval(every) => write!(
                f,
                "the time between checkpoints must be positive and finite, but is {every}"
            ),
        }
    }
}

impl core::error::Error for RunConflict {}

impl From<RunConflict> for SimulationError {
    fn from(conflict: RunConflict) -> Self {
        Self::new("settings-refused", conflict, conflict.hint()).with_cause(conflict)
    }
}
