//! Errors that keep reactions from being evaluated.

use crate::natural::ModelError;

/// A scene whose reactions are not evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ReactionError {
    /// The model is not the scene's.
    Model(ModelError),
    /// One group of loops has more wrench components than the dense elimination takes.
    TooLarge {
        /// Wrench components of the group.
        unknowns: usize,
        /// The largest number taken.
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
