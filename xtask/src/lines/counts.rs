//! Counts of the lines of a crate.

use std::collections::BTreeMap;

/// Modules whose functions are large and needed by many, with the crate that owns them.
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
    /// Of each of [`OWNED`].
    pub(super) owned: [u64; OWNED.len()],
}

/// The counts of each crate of ours in both sets.
pub(super) type Counted = [BTreeMap<String, Counts>; 2];
