//! Errors that prevent the evaluation of reactions.

use crate::natural::ModelError;

/// Error: the reactions of a scene cannot be evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ReactionError {
    /// The model does not belong to the scene.
    Model(ModelError),
    /// A group of coupled loops has more wrench components than the dense elimination allows.
    TooLarge {
        /// Number of wrench components of the group.
        unknowns: usize,
        /// Largest number that is allowed.
        limit: usize,
    },
}

impl core::fmt::Display for ReactionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Model(error) => write!(f, "{error}"),
            Self::TooLarge { unknowns, limit } => write!(
                f,
                "reactions of {unknowns} components in connected loops: at most {limit} are evaluated together; leave the reaction outputs out"
            ),
        }
    }
}

impl core::error::Error for ReactionError {}

impl From<ModelError> for ReactionError {
    fn from(error: ModelError) -> Self {
        Self::Model(error)
    }
}
