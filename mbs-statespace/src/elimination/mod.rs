//! Sparse Gaussian elimination of a rectangular matrix. Pivots are chosen once and reused for many matrices of the same pattern.
//!
//! ```text
//! J = [J_d J_i] (columns),   J_d = L U on the r pivot rows,   the other rows of J repeat them
//! R = [-J_d^-1 J_i; 1],      J R = 0                                                          [P1 (21)]
//! ```
//!
//! [`Elimination::select_pivots`] finds the rank, the pivot rows and the dependent columns. [`Elimination::refactor`] repeats the
//! arithmetic for new numbers in the same order. The pivot columns are the dependent unknowns, the other columns are the independent ones.

mod choose;
mod factor;
mod order;
mod pattern;
mod select;

use alloc::vec;
use alloc::vec::Vec;
use choose::Chooser;
use mbs_core::Real;
use pattern::index;

pub use order::Order;
pub use pattern::Pattern;

/// Quality of the pivots, measured in the matrix with rows of unit length and scaled columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pivots<T> {
    /// Size of the smallest pivot.
    pub smallest: T,
    /// Row of the smallest pivot.
    pub row: u32,
    /// Smallest ratio of a pivot to the size of the same pivot at the last choice [-].
    pub decay: T,
}

/// Result of the choice by [`Elimination::select_pivots`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PivotSelection<T> {
    /// Rank r of the matrix.
    pub rank: usize,
    /// Row of the last accepted pivot, and its size in the scaled matrix.
    pub last: (u32, T),
    /// Row and size of the largest entry that remains after all pivots; zero where no row remains.
    pub rest: (u32, T),
}

/// An elimination of matrices of one pattern, described in this module's documentation.
#[derive(Debug, Clone)]
pub struct Elimination<T> {
    pattern: Pattern,
    rank: usize,
    /// Pivot rows in the order of elimination, then the dropped (redundant) rows.
    rows: Vec<u32>,
    /// Dependent columns in the order of elimination, then the independent ones, ascending.
    unknowns: Vec<u32>,
    /// Index of each column in `unknowns`.
    places: Vec<u32>,
    /// Factor L without its unit diagonal, row by row; columns by place in `unknowns`.
    lower: Triangle<T>,
    /// Factor U without its diagonal, row by row, including the independent columns; columns by place in `unknowns`.
    upper: Triangle<T>,
    /// Inverses 1 / pivot of all pivots.
    inverses: Vec<T>,
    /// Scales of rows and columns at the last choice, and the sizes of the scaled pivots at that choice.
    row_scales: Vec<T>,
    column_scales: Vec<T>,
    chosen: Vec<T>,
    /// Scratch for one row, by place in `unknowns`.
    work: Vec<T>,
    chooser: Chooser<T>,
}

/// A sparse triangular matrix, stored row by row.
#[derive(Debug, Clone, Default)]
struct Triangle<T> {
    starts: Vec<u32>,
    places: Vec<u32>,
    values: Vec<T>,
}

impl<T: Real> Triangle<T> {
    fn row(&self, k: usize) -> core::ops::Range<usize> {
        self.starts[k] as usize..self.starts[k + 1] as usize
    }
    fn clear(&mut self) {
        self.starts.clear();
        self.places.clear();
        self.values.clear();
        self.starts.push(0);
    }
    fn close_row(&mut self) {
        self.values.resize(self.places.len(), T::ZERO);
        self.starts.push(index(self.places.len()));
    }
    fn reserve(&mut self, rows: usize, entries: usize) {
        self.starts.reserve(rows + 1);
        self.places.reserve(entries.saturating_sub(self.places.len()));
        self.values.reserve(entries.saturating_sub(self.values.len()));
    }
}

impl<T: Real> Elimination<T> {
    /// Creates an elimination for matrices of `pattern`. Its rank is zero until pivots are chosen.
    ///
    /// Columns are compared after scaling by `column_scales`: a column with a larger scale becomes dependent earlier.
    ///
    /// # Panics
    /// When the length of `column_scales` is not the number of columns.
    #[must_use]
    pub fn new(pattern: Pattern, column_scales: Vec<T>) -> Self {
        let (m, n) = (pattern.n_rows(), pattern.n_columns);
        assert_eq!(column_scales.len(), n, "one scale for each column");
        let least = m.min(n);
        let mut new = Self {
            rank: 0,
            rows: (0..m).map(index).collect(),
            unknowns: (0..n).map(index).collect(),
            places: (0..n).map(index).collect(),
            lower: Triangle::default(),
            upper: Triangle::default(),
            inverses: Vec::with_capacity(least),
            row_scales: vec![T::ONE; m],
            column_scales,
            chosen: Vec::with_capacity(least),
            work: vec![T::ZERO; n],
            chooser: Chooser::new(&pattern),
            pattern,
        };
        new.lower.clear();
        new.upper.clear();
        new.reserve(4 * new.pattern.columns.len());
        new
    }

    /// Pattern of the matrices.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }
    /// The rank r found at the last choice.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }
    /// The pivot rows, in the order of elimination.
    #[must_use]
    pub fn pivot_rows(&self) -> &[u32] {
        &self.rows[..self.rank]
    }
    /// The redundant rows, which depend on the pivot rows.
    #[must_use]
    pub fn dropped_rows(&self) -> &[u32] {
        &self.rows[self.rank..]
    }
    /// The dependent columns, in the order of elimination.
    #[must_use]
    pub fn dependent(&self) -> &[u32] {
        &self.unknowns[..self.rank]
    }
    /// The independent columns, ascending.
    #[must_use]
    pub fn independent(&self) -> &[u32] {
        &self.unknowns[self.rank..]
    }
    /// Place of a column in the order: `k < r` is the k-th dependent one, `r + i` the i-th independent one.
    #[inline]
    #[must_use]
    pub fn place(&self, column: usize) -> usize {
        self.places[column] as usize
    }
    /// The scale of a column in the choice.
    #[inline]
    #[must_use]
    pub fn column_scale(&self, column: usize) -> T {
        self.column_scales[column]
    }
    /// Number of entries of L and U together. The diagonal of U is counted, that of L is not.
    #[must_use]
    pub fn n_entries(&self) -> usize {
        self.lower.places.len() + self.upper.places.len() + self.rank
    }

    /// Reserves memory for factors with `entries` entries, so that later choices need not allocate.
    pub fn reserve(&mut self, entries: usize) {
        let m = self.pattern.n_rows();
        self.lower.reserve(m, entries);
        self.upper.reserve(m, entries);
        self.chooser.reserve(entries);
    }
}
