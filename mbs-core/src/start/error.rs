//! Errors of the assembly of a scene at the start.

use crate::model::Owner;
use crate::natural::ModelError;

/// Error: the scene cannot start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum AssemblyError {
    /// The scene gives no model.
    Model(ModelError),
    /// Loops, guides and prescribed start coordinates cannot be satisfied together.
    Position {
        /// Largest remaining residual [m or rad].
        residual: f64,
        /// Owner of the row that is not satisfied.
        owner: Owner,
        /// Index of the `[[initial]]` entry of the row, if it has one.
        initial: Option<usize>,
        /// Value at which the coordinate of `owner` stopped on the path to its prescribed value, and that value [rad or m]. The mechanism
        /// locks there, or prescribed values contradict each other. `None` if no prescribed value was being approached.
        reached: Option<[f64; 2]>,
    },
    /// The search for the smallest change from the reference configuration did not converge.
    NotLeast {
        /// Last correction of the search, relative to the scene's length.
        correction: f64,
    },
    /// Prescribed velocities contradict each other or the joints.
    Velocity {
        /// Largest remaining residual [m/s or rad/s].
        residual: f64,
        /// Owner of the row that is not satisfied.
        owner: Owner,
        /// Index of the `[[initial]]` entry of the row, if it has one.
        initial: Option<usize>,
    },
    /// Accelerations are not determined: a force acts on a coordinate without inertia.
    NoInertia {
        /// Owner of the coordinate that has no inertia.
        owner: Owner,
    },
    /// No accelerations satisfy the constraints.
    Acceleration {
        /// Largest remaining residual [m/s^2].
        residual: f64,
        /// Owner of the row that is not satisfied.
        owner: Owner,
    },
}

impl core::fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Model(e) => write!(f, "{e}"),
            Self::Position { reached: Some([reached, value]), .. } => write!(
                f,
                "the mechanism cannot be put together: on its way to {value} rad (or m) the coordinate stops at {reached}"
            ),
            Self::Position { residual, .. } => write!(
                f,
                "the mechanism cannot be closed at the start: {residual:.3e} m (or rad) is left open"
            ),
            Self::NotLeast { correction } => write!(
                f,
                "the search for the least changed start did not end: its last correction was {correction:.3e} of the size"
            ),
            Self::Velocity { residual, .. } => write!(
                f,
                "the initial velocities contradict the joints or each other by {residual:.3e} m/s (or rad/s)"
            ),
            Self::NoInertia { .. } => write!(
                f,
                "a force would meet no inertia: a coordinate is neither determined by joints nor has mass"
            ),
            Self::Acceleration { residual, .. } => write!(
                f,
                "no accelerations meet the constraints at the start ({residual:.3e} m/s^2 is left): the mechanism stands in a singular position or locks"
            ),
        }
    }
}

impl core::error::Error for AssemblyError {}

impl From<ModelError> for AssemblyError {
    fn from(error: ModelError) -> Self {
        Self::Model(error)
    }
}
