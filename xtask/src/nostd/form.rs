//! Extent of the check of controllers: short among the other checks, long if it is run alone.

/// Extent of the check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Form {
    /// Two targets and one board; images without features and with all features.
    Short,
    /// All targets, boards and models; also an image with each feature.
    Whole,
}
