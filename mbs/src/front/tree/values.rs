//! What a tree answers with.

use super::layout::Layout;
use crate::front::values::PointMotion;
use mbs_core::algebra::Vector;
use std::ops::Index;

/// A dense matrix, row by row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Matrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// The numbers: entry (i, j) is `data[i * columns + j]`.
    pub data: Vec<f64>,
}

impl Matrix {
    pub(super) fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, data: vec![0.0; rows * columns] }
    }

    pub(super) fn resize_rows(&mut self, rows: usize) {
        self.rows = rows;
        self.data.resize(rows * self.columns, 0.0);
    }

    /// Takes rows in the tree's order over into the joints' own.
    pub(super) fn take_rows(&mut self, layout: &Layout, rows: &[f64]) {
        let n = self.columns.max(1);
        for (own, tree) in self.data.chunks_exact_mut(n).zip(rows.chunks_exact(n)) {
            layout.efforts_outward(tree, own);
        }
    }

    /// A row.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn row(&self, i: usize) -> &[f64] {
        &self.data[i * self.columns..][..self.columns]
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.row(i)[j]
    }
}

impl PointMotion {
    pub(super) fn of(motion: [Vector<f64, 3>; 3]) -> Self {
        let [position, velocity, acceleration] = motion.map(Into::into);
        Self { position, velocity, acceleration }
    }
}
