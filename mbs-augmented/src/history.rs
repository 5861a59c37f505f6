//! What one step leaves for the next beside the state, to look at and to go on from.

use crate::index_change::ConstraintIndex;
use alloc::vec::Vec;
use mbs_core::step::Counts;

/// What a [`Workspace`](crate::Workspace) remembers from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Factor on the penalty, as it has adapted [-].
    pub boost: T,
    /// Ratio of the most weakly determined combination of constraints before and after one correction [-].
    pub rho: T,
    /// That combination, m.
    pub probe: Vec<T>,
    /// Counts of a change of index that no step has reported yet.
    pub settled: Counts,
}

/// What an [`IndexChange`](crate::IndexChange) remembers from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexHistory<T> {
    /// The present index.
    pub index: ConstraintIndex,
    /// Changes of it so far.
    pub changes: u32,
    /// The last trial, and the last step that was kept [s].
    pub tried: T,
    /// See `tried`.
    pub last: T,
}
