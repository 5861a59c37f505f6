//! Errors that prevent a model of a checked scene.

use crate::actions::ActionError;

/// Reason why a scene that passed its checks gives no model.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ModelError {
    /// The dimension of the model differs from that of the scene.
    Dimension,
    /// No basis was found for this body.
    Basis {
        /// Index of the body without a basis.
        body: usize,
    },
    /// An effect or output needs the full rotation of a body that is a rod held by ball joints. Such a rod has no rotation about
    /// its line.
    NoRotation {
        /// Index of the body, a rod held by ball joints.
        body: usize,
    },
    /// The law of an enabled effect is not part of the build.
    LeftOut {
        /// Index of the effect whose law is missing.
        effect: usize,
        /// Cargo feature of mbs-core that adds the law.
        feature: &'static str,
    },
}

impl From<ActionError> for ModelError {
    fn from(error: ActionError) -> Self {
        match error {
            ActionError::LeftOut { effect, feature } => Self::LeftOut { effect, feature },
        }
    }
}

impl core::fmt::Display for ModelError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Dimension => write!(f, "the model's dimension is not the scene's"),
            Self::Basis { .. } => {
                write!(f, "no independent points and directions for the body: check its data")
            }
            Self::NoRotation { .. } => {
                write!(
                    f,
                    "a rod held by balls carries no rotation about itself: give the body a full inertia"
                )
            }
            Self::LeftOut { effect, feature } => {
                ActionError::LeftOut { effect: *effect, feature }.fmt(f)
            }
        }
    }
}

impl core::error::Error for ModelError {}
