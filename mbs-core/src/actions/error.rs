//! Errors that keep an effect from being acted out.

/// A scene whose effects give no actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ActionError {
    /// The law of an enabled effect is not compiled.
    LeftOut {
        /// Index of the effect whose law is not compiled.
        effect: usize,
        /// The Cargo feature of mbs-core that brings it.
        feature: &'static str,
    },
}

impl core::fmt::Display for ActionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::LeftOut { feature, .. } => write!(
                f,
                "the law was left out of this build: switch on the feature `{feature}` of mbs-core, or set enabled = false"
            ),
        }
    }
}

impl core::error::Error for ActionError {}
