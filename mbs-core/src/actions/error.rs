//! Errors that prevent the conversion of effects to actions.

/// Reason why the effects of a scene give no actions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ActionError {
    /// The law of an enabled effect is not part of the build.
    LeftOut {
        /// Index of the effect whose law is missing.
        effect: usize,
        /// Cargo feature of mbs-core that adds the law.
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
