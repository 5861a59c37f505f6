//! One dense step of the elimination: its pivots, its parts and its storage.

pub(crate) use mbs_math::dense::front::column;
use std::ops::Range;

/// Content of a front before anything is added to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FrontInit {
    /// Zeros.
    Zeros,
    /// The block of the first element, which has all unknowns of the front in the same order.
    Written,
    /// The block of the first element, which has all unknowns of the front in another order.
    Permuted,
    /// Zeros, followed by elements that are all small and are added together.
    Gathered,
}

/// One dense step of the elimination.
#[derive(Debug, Clone)]
pub(crate) struct Front {
    /// Number of unknowns that the front eliminates.
    pub(crate) p: usize,
    /// Number of unknowns of the front.
    pub(crate) f: usize,
    /// Offset of the front in the array of all fronts.
    pub(crate) offset: usize,
    /// Position of the first pivot in the elimination order.
    pub(crate) first: usize,
    /// Range of the remaining rows in the list of all rows.
    pub(crate) rows: Range<usize>,
    /// Initial content of the front.
    pub(crate) init: FrontInit,
    /// Index of the first pivot in the storage of a vector for its task.
    pub(crate) at: usize,
    /// Range of the front's elements in the list of all elements.
    pub(crate) elements: Range<usize>,
    /// Range of the front's children in the list of all children.
    pub(crate) children: Range<usize>,
}
