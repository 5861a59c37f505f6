//! Extent of the check of controllers: the short form among the other checks, the whole alone.

/// Extent of the check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Form {
    /// Two targets, one board, images without features and with all of them.
    Short,
    /// All targets, boards and models, and an image with each feature.
    Whole,
}
