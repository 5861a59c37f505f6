//! State of a workspace that the next step continues from, to look at and to restore.

use alloc::vec::Vec;
use mbs_core::step::Counts;

/// State of a [`Workspace`](crate::Workspace) that the next step continues from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Factor on the penalty, as it has adapted [-].
    pub penalty_factor: T,
    /// Factor on the penalty since a step failed, else one [-].
    pub penalty_strength: T,
    /// Ratio of the most weakly determined combination of constraints before and after one correction [-].
    pub contraction: T,
    /// Combination of constraints that is most weakly determined, m.
    pub weakest_combination: Vec<T>,
    /// Counts of the work for a change of index, which the report of no step contains yet.
    pub settled: Counts,
}
