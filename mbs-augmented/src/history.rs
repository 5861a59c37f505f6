//! State of a workspace on which the next step depends, to read and to restore.

use alloc::vec::Vec;
use mbs_core::step::Counts;

/// State of a [`Workspace`](crate::Workspace) on which the next step depends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Factor on the penalty, adapted from step to step [-].
    pub penalty_factor: T,
    /// Factor on the penalty after a step has failed; 1 if none has failed [-].
    pub penalty_strength: T,
    /// Fraction of the weakest combination of constraints that one correction leaves [-].
    pub contraction: T,
    /// Combination of constraints that is determined most weakly; one weight for each row.
    pub weakest_combination: Vec<T>,
    /// Counts of the work for a change of index that are not yet in the report of a step.
    pub settled: Counts,
}
