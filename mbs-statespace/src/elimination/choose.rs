//! Choice of pivots: Markowitz' count among the entries that are large relative to the remaining matrix.
//!
//! ```text
//! s = D J E,   D: rows of unit length,   E: column scales
//! pivot (i, j): |s_ij| >= u max|s|,   least (entries of row i - 1)(entries of column j - 1) among the shortest rows
//! rank: the pivots until max|s| <= max(m, n) eps^(5/8)
//! ```
//!
//! A threshold relative to the whole remaining matrix, rather than to one row or column, reveals the rank. The matrix is a list of entries
//! linked along rows and columns. An entry belongs to the pattern even if its value is zero. Therefore the order found is valid for other
//! values too.

use super::pattern::{Pattern, index};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// Number of rows that are searched for one pivot [-].
const SEARCHED: usize = 6;
/// Index that stands for no entry, no row and no column.
pub(super) const NONE: u32 = u32::MAX;

/// One entry of the matrix during elimination.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<T> {
    pub(super) row: u32,
    pub(super) column: u32,
    pub(super) value: T,
    pub(super) next_in_row: u32,
    next_in_column: u32,
}

/// Scratch memory of a choice of pivots.
#[derive(Debug, Clone)]
pub(super) struct Chooser<T> {
    pub(super) entries: Vec<Entry<T>>,
    pub(super) row_heads: Vec<u32>,
    column_heads: Vec<u32>,
    /// Number of remaining entries in each row and column.
    row_counts: Vec<u32>,
    column_counts: Vec<u32>,
    /// Size of the largest remaining entry in each row.
    row_sizes: Vec<T>,
    /// The elimination step of each row and column.
    pub(super) row_steps: Vec<u32>,
    pub(super) column_steps: Vec<u32>,
    /// Index of the entry of the current row in each column.
    at: Vec<u32>,
}

impl<T: Real> Chooser<T> {
    pub(super) fn new(pattern: &Pattern) -> Self {
        let (m, n) = (pattern.n_rows(), pattern.n_columns);
        Self {
            entries: Vec::new(),
            row_heads: vec![NONE; m],
            column_heads: vec![NONE; n],
            row_counts: vec![0; m],
            column_counts: vec![0; n],
            row_sizes: vec![T::ZERO; m],
            row_steps: vec![NONE; m],
            column_steps: vec![NONE; n],
            at: vec![NONE; n],
        }
    }

    pub(super) fn reserve(&mut self, entries: usize) {
        self.entries.reserve(entries.saturating_sub(self.entries.len()));
    }

    fn push(&mut self, row: u32, column: u32, value: T) {
        let (r, c) = (row as usize, column as usize);
        let next_in_row = core::mem::replace(&mut self.row_heads[r], index(self.entries.len()));
        let next_in_column =
            core::mem::replace(&mut self.column_heads[c], index(self.entries.len()));
        self.entries.push(Entry { row, column, value, next_in_row, next_in_column });
        self.row_counts[r] += 1;
        self.column_counts[c] += 1;
    }

    pub(super) fn load(&mut self, pattern: &Pattern, values: &[T]) {
        self.entries.clear();
        self.row_heads.fill(NONE);
        self.column_heads.fill(NONE);
        self.row_counts.fill(0);
        self.column_counts.fill(0);
        self.row_steps.fill(NONE);
        self.column_steps.fill(NONE);
        self.at.fill(NONE);
        for r in 0..pattern.n_rows() {
            for t in pattern.row(r) {
                self.push(index(r), pattern.columns[t], values[t]);
            }
        }
    }

    /// Returns an index with the entry that it refers to; `None` at the end of a row's list.
    pub(super) fn along(&self, at: u32) -> Option<(u32, Entry<T>)> {
        (at != NONE).then(|| (at, self.entries[at as usize]))
    }

    pub(super) fn measure(&mut self, row: usize, (row_scale, column_scales): (T, &[T])) {
        let (mut size, mut next) = (T::ZERO, self.row_heads[row]);
        while let Some((_, e)) = self.along(next) {
            let c = e.column as usize;
            if self.column_steps[c] == NONE {
                size = size.max(e.value.abs() * row_scale * column_scales[c]);
            }
            next = e.next_in_row;
        }
        self.row_sizes[row] = size;
    }

    /// Returns the row and the size of the largest remaining entry.
    pub(super) fn rest(&self) -> (u32, T) {
        let mut best = (0, T::ZERO);
        for (r, (&size, &step)) in self.row_sizes.iter().zip(&self.row_steps).enumerate() {
            if step == NONE && size > best.1 {
                best = (index(r), size);
            }
        }
        best
    }

    /// Returns the next pivot: an entry of at least the size `least` that creates few new entries.
    pub(super) fn pivot(&self, least: T, (row_scales, column_scales): (&[T], &[T])) -> Option<u32> {
        let is_open = |r: usize| self.row_steps[r] == NONE && self.row_sizes[r] >= least;
        let open = || (0..self.row_sizes.len()).filter(|&r| is_open(r));
        let shortest = open().map(|r| self.row_counts[r]).min()?;
        let mut best: Option<(u64, T, u32)> = None;
        for r in open().filter(|&r| self.row_counts[r] == shortest).take(SEARCHED) {
            let mut next = self.row_heads[r];
            while let Some((at, e)) = self.along(next) {
                next = e.next_in_row;
                let c = e.column as usize;
                let size = e.value.abs() * row_scales[r] * column_scales[c];
                if self.column_steps[c] != NONE || !(size >= least) {
                    continue;
                }
                let cost = u64::from(shortest - 1) * u64::from(self.column_counts[c] - 1);
                let is_better = best.is_none_or(|(c, s, _)| cost < c || (cost == c && size > s));
                if is_better {
                    best = Some((cost, size, at));
                }
            }
        }
        best.map(|(_, _, at)| at)
    }

    /// Returns the remaining entry at a row and column.
    pub(super) fn entry(&self, row: u32, column: u32) -> Option<u32> {
        let mut next = self.row_heads[row as usize];
        while let Some((at, e)) = self.along(next) {
            if e.column == column {
                return Some(at);
            }
            next = e.next_in_row;
        }
        None
    }

    /// Subtracts a multiple of the pivot's row from every row with an entry in the pivot's column.
    pub(super) fn eliminate(
        &mut self,
        pivot: u32,
        step: u32,
        (row_scales, column_scales): (&[T], &[T]),
    ) {
        let pivot = self.entries[pivot as usize];
        let (p, c) = (pivot.row as usize, pivot.column as usize);
        self.row_steps[p] = step;
        self.column_steps[c] = step;
        let mut next = self.column_heads[c];
        while let Some((_, e)) = self.along(next) {
            next = e.next_in_column;
            let r = e.row as usize;
            if self.row_steps[r] == NONE {
                self.subtract(p, r, e.value / pivot.value);
                self.row_counts[r] -= 1;
                self.measure(r, (row_scales[r], column_scales));
            }
        }
        let mut next = self.row_heads[p];
        while let Some((_, e)) = self.along(next) {
            next = e.next_in_row;
            self.column_counts[e.column as usize] -= 1;
        }
    }

    /// Subtracts rows, row r -= factor * row p, over the remaining columns.
    fn subtract(&mut self, p: usize, r: usize, factor: T) {
        let mut next = self.row_heads[r];
        while let Some((at, e)) = self.along(next) {
            self.at[e.column as usize] = at;
            next = e.next_in_row;
        }
        let mut next = self.row_heads[p];
        while let Some((_, e)) = self.along(next) {
            next = e.next_in_row;
            let c = e.column as usize;
            if self.column_steps[c] != NONE {
                continue;
            }
            match self.at[c] {
                NONE => self.push(index(r), e.column, -factor * e.value),
                at => self.entries[at as usize].value -= factor * e.value,
            }
        }
        let mut next = self.row_heads[r];
        while let Some((_, e)) = self.along(next) {
            self.at[e.column as usize] = NONE;
            next = e.next_in_row;
        }
    }
}

/// Returns the size up to which entries of the scaled matrix count as zero: max(m, n) EPSILON^(5/8).
pub(crate) fn rank_tolerance<T: Real>(size: usize) -> T {
    let eighth = T::EPSILON.sqrt().sqrt().sqrt();
    let square = eighth * eighth;
    square * square * eighth * T::from_f64(size as f64)
}
