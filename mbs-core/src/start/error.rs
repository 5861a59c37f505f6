//! Why a scene cannot be put together.

use crate::model::Owner;
use crate::natural::ModelError;

/// A scene that cannot start.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum AssemblyError {
    /// No model.
    Model(ModelError),
    /// Loops, guides and held coordinates cannot be met together.
    Position {
        /// Largest residual left [m or rad].
        residual: f64,
        /// What it belongs to.
        owner: Owner,
        /// The `[[initial]]` entry concerned, if it is one.
        initial: Option<usize>,
    },
    /// Held velocities contradict each other or the joints.
    Velocity {
        /// Largest residual left [m/s or rad/s].
        residual: f64,
        /// What it belongs to.
        owner: Owner,
        /// The `[[initial]]` entry concerned, if it is one.
        initial: Option<usize>,
    },
    /// Accelerations do not follow: a force meets no inertia there.
    NoInertia {
        /// What it belongs to.
        owner: Owner,
    },
    /// Accelerations do not meet the constraints.
    Acceleration {
        /// Largest residual left [m/s^2].
        residual: f64,
        /// What it belongs to.
        owner: Owner,
    },
}

impl core::fmt::Display for AssemblyError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Model(e) => write!(f, "{e}"),
            Self::Position { residual, .. } => write!(
                f,
                "the mechanism cannot be closed at the start: {residual:.3e} m (or rad) is left open"
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
