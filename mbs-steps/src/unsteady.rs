//! Reason why a motion is not steady, as text and JSON.

use mbs_scene::format::few;
use serde_json::{Value, json};

/// Reason why a motion is not steady.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Unsteady {
    /// A state of the linear system accelerates in the axes that turn with the motion.
    Accelerates {
        /// Name of the state.
        state: String,
        /// Absolute value of the acceleration of the state [rad/s^2 or m/s^2].
        by: f64,
        /// Unit of the acceleration.
        unit: &'static str,
    },
    /// The linear equations change along the motion.
    Changes {
        /// Name of the state in whose equation a coefficient changes most.
        state: String,
        /// Change of this coefficient per radian of the motion, relative to the largest coefficient of its row [1/rad].
        by: f64,
    },
}

impl Unsteady {
    /// Returns the reason as one JSON object.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let (state, by, unit) = match self {
            Self::Accelerates { state, by, unit } => (state, by, *unit),
            Self::Changes { state, by } => (state, by, "1/rad"),
        };
        json!({ "state": state, "by": by, "unit": unit })
    }
}

impl core::fmt::Display for Unsteady {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Accelerates { state, by, unit } => {
                write!(f, "`{state}` accelerates by {} {unit}: this is no steady motion", few(*by))
            }
            Self::Changes { state, by } => write!(
                f,
                "the linear equation of `{state}` changes along the motion, by {} of itself in a radian: eigenvalues do not say what grows",
                few(*by)
            ),
        }
    }
}
