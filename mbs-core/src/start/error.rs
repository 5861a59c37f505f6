//! Reasons why a scene cannot be put together.

use crate::model::Owner;
use crate::natural::ModelError;

/// A scene that cannot start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum AssemblyError {
    /// Scene that gives no model.
    Model(ModelError),
    /// Loops, guides and held coordinates cannot be met together.
    Position {
        /// Largest residual left [m or rad].
        residual: f64,
        /// Owner of the row that is not met.
        owner: Owner,
        /// The `[[initial]]` entry concerned, if it is one.
        initial: Option<usize>,
        /// The value at which the mechanism stopped on its way to that of `owner`, and that value [rad or m]: it locks there, or what
        /// is held contradicts itself. `None` where it was not on its way.
        reached: Option<[f64; 2]>,
    },
    /// The change from the reference configuration has no least value that could be found.
    NotLeast {
        /// The last correction of the search, relative to the scene's length.
        correction: f64,
    },
    /// Held velocities contradict each other or the joints.
    Velocity {
        /// Largest residual left [m/s or rad/s].
        residual: f64,
        /// Owner of the row that is not met.
        owner: Owner,
        /// The `[[initial]]` entry concerned, if it is one.
        initial: Option<usize>,
    },
    /// Accelerations do not follow: a force meets no inertia there.
    NoInertia {
        /// Owner of the coordinate that has no inertia.
        owner: Owner,
    },
    /// Accelerations do not meet the constraints.
    Acceleration {
        /// Largest residual left [m/s^2].
        residual: f64,
        /// Owner of the row that is not met.
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
