//! The pattern of a sparse matrix.

use alloc::vec::Vec;

/// The pattern of a sparse matrix, row by row. The numbers of a matrix are a separate slice in the same order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// Number of columns n.
    pub n_columns: usize,
    /// Index of each row's first entry in `columns`, and the end of the last row: m + 1 numbers.
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

    /// Range of the entries of `row` in `columns`.
    #[inline]
    #[must_use]
    pub fn row(&self, row: usize) -> core::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
}

/// Converts a count to u32. It fits, because a matrix of more than 4e9 entries exceeds the memory.
pub(super) fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
