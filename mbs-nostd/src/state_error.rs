//! [`StateError`]: reason why a state cannot be set.

use mbs_core::step::StepError;

/// Reason why a state cannot be set. Outputs and later steps of the solver are then the same, to the bit, as without the call.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StateError {
    /// A list does not have the length that the model needs.
    Length {
        /// Name of the list, `coordinates` or `velocities`.
        of: &'static str,
        /// Length that the list has.
        given: usize,
        /// Length that the model needs.
        needed: usize,
    },
    /// A number is infinite or NaN.
    NotFinite {
        /// Name of the list, `coordinates` or `velocities`.
        of: &'static str,
        /// Index of the entry in the list, from 0.
        entry: usize,
    },
    /// The quaternion of a ball joint or a free link cannot be normalised. It is shorter than √ε with the machine precision ε, or its
    /// square overflows.
    Quaternion {
        /// Index of the quaternion's first entry in the coordinates.
        entry: usize,
    },
    /// The loops do not close: the projection does not converge from this state.
    Open {
        /// Level of the equations: 0 for positions, 1 for velocities.
        level: u8,
        /// Index of the row with the largest violation.
        row: u32,
        /// Violation that remains [m or rad, m/s or rad/s].
        violation: f64,
    },
    /// The loops cannot be closed, or the state has no accelerations. [`StepError::Tables`] means that the solver was made for another
    /// model.
    Failed(StepError),
}

impl From<StepError> for StateError {
    fn from(error: StepError) -> Self {
        match error {
            StepError::Violated { level: level @ (0 | 1), violation, row } => {
                Self::Open { level, row, violation }
            }
            error => Self::Failed(error),
        }
    }
}

impl core::fmt::Display for StateError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Length { of, given, needed } => {
                write!(f, "{given} {of} are given, and the model has {needed}")
            }
            Self::NotFinite { of, entry } => {
                write!(f, "number {entry} of the {of} is not finite: set a finite value")
            }
            Self::Quaternion { entry } => write!(
                f,
                "the quaternion from coordinate {entry} has no direction: set one of length near one"
            ),
            Self::Open { level, row, violation } => write!(
                f,
                "loops stay open: row {row} of the {} is violated by {violation:e}; set a state nearer to a closed one",
                if *level == 0 { "positions" } else { "velocities" }
            ),
            Self::Failed(StepError::NotFinite { .. } | StepError::Violated { .. }) => {
                f.write_str("there are no accelerations at that state: set smaller velocities, or one off a singular position")
            }
            Self::Failed(error) => write!(f, "at the state that was to be set: {error}"),
        }
    }
}

impl core::error::Error for StateError {}
