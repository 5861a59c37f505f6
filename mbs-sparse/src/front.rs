//! One dense step of the elimination: what it eliminates, and where its numbers stand.

pub(crate) use mbs_math::dense::front::column;
use std::ops::Range;

/// Content of a front before anything is added to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontInit {
    /// Zeros.
    Zeros,
    /// The block of its first element, which has all its unknowns in its order.
    Written,
    /// The block of its first element, which has all its unknowns in another order.
    Permuted,
    /// Zeros, for elements that are all small: they are added together.
    Gathered,
}

/// One dense step of the elimination.
#[derive(Debug, Clone)]
pub(crate) struct Front {
    /// Number of unknowns eliminated here.
    pub(crate) p: usize,
    /// Unknowns of the front.
    pub(crate) f: usize,
    /// Start in the array of all fronts.
    pub(crate) offset: usize,
    /// Place of the first pivot in the elimination order.
    pub(crate) first: usize,
    /// Places of the remaining rows in the list of all rows.
    pub(crate) rows: Range<usize>,
    /// How its first numbers come.
    pub(crate) init: FrontInit,
    /// Place of the first pivot in the own vector of its task.
    pub(crate) at: usize,
    /// Range of its elements in the list of all elements.
    pub(crate) elements: Range<usize>,
    /// Range of its children in the list of all children.
    pub(crate) children: Range<usize>,
}
