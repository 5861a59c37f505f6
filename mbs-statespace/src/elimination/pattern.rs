//! The pattern of a sparse matrix.

use alloc::vec::Vec;

/// The pattern of a sparse matrix, row by row. The numbers stand in a slice of their own, in the same order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// Number of columns n.
    pub n_columns: usize,
    /// Starts of the rows in `columns`, and the end of the last row: m + 1 places.
    pub starts: Vec<u32>,
    /// The columns of the entries, distinct within a row.
    pub columns: Vec<u32>,
}

impl Pattern {
    /// Number of rows m.
    #[must_use]
    pub fn n_rows(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The places of the entries of `row`.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> core::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
}

/// Returns a count as u32: it fits, since more than 4e9 entries do not fit a memory.
pub(super) fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
