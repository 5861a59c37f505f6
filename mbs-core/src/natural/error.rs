//! Errors that keep a checked scene from becoming a model.

use crate::actions::ActionError;

/// A scene that passed its checks but gives no model.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ModelError {
    /// The model's dimension is not the scene's.
    Dimension,
    /// No basis for this body could be found.
    Basis {
        /// Index of the body without a basis.
        body: usize,
    },
    /// An effect or output asks for a rotation that this body, a rod held by balls, does not carry.
    NoRotation {
        /// Index of the body, a rod held by balls.
        body: usize,
    },
    /// The law of an enabled effect is not compiled.
    LeftOut {
        /// Index of the effect whose law is not compiled.
        effect: usize,
        /// The Cargo feature of mbs-core that brings it.
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
