//! State of a workspace that the next step continues from, to read and to restore.

use alloc::vec::Vec;
use mbs_core::step::Counts;

/// State of a [`Workspace`](crate::Workspace) that the next step continues from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Factor on the penalty, adapted from step to step [-].
    pub penalty_factor: T,
    /// Factor on the penalty after a step has failed; one before [-].
    pub penalty_strength: T,
    /// Contraction of the weakest combination of constraints in one correction [-].
    pub contraction: T,
    /// Most weakly determined combination of constraints, one weight for each row.
    pub weakest_combination: Vec<T>,
    /// Counts of the work for a change of index that no report of a step contains yet.
    pub settled: Counts,
}
