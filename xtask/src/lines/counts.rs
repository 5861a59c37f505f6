//! Counts of the lines of a crate.

use std::collections::BTreeMap;

/// Modules with large functions that many crates call, each with the crate that owns it.
pub(super) const OWNED: [(&str, &str); 4] = [
    ("mbs_core", "natural"),
    ("mbs_core", "start"),
    ("mbs_core", "outputs"),
    ("mbs_recursive", "build::tree"),
];

/// The counts of a crate.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) lines: u64,
    /// Number of lines of each module of [`OWNED`].
    pub(super) owned: [u64; OWNED.len()],
}

/// The counts of each crate of the workspace, in both sets of features.
pub(super) type Counted = [BTreeMap<String, Counts>; 2];
