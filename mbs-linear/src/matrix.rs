//! Dense matrices of any size for the analyses of a mechanism.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::{Index, IndexMut};

/// A dense matrix, stored column by column.
#[derive(Debug, Clone, PartialEq)]
pub struct Matrix {
    n_rows: usize,
    n_columns: usize,
    entries: Vec<f64>,
}

impl Matrix {
    /// Creates a matrix of zeros.
    #[must_use]
    pub fn zeros(n_rows: usize, n_columns: usize) -> Self {
        Self { n_rows, n_columns, entries: vec![0.0; n_rows * n_columns] }
    }

    /// Creates a matrix with ones on the diagonal; it need not be square.
    #[must_use]
    pub fn identity(n_rows: usize, n_columns: usize) -> Self {
        let mut all = Self::zeros(n_rows, n_columns);
        (0..n_rows.min(n_columns)).for_each(|i| all[(i, i)] = 1.0);
        all
    }

    /// Creates a matrix from a function of row and column.
    pub fn from_fn(n_rows: usize, n_columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let columns = 0..n_columns;
        let entries = columns.flat_map(|j| (0..n_rows).map(move |i| (i, j)));
        Self { n_rows, n_columns, entries: entries.map(|(i, j)| entry(i, j)).collect() }
    }

    /// Number of rows.
    #[must_use]
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Number of columns.
    #[must_use]
    pub fn n_columns(&self) -> usize {
        self.n_columns
    }

    /// Column `j` of the matrix.
    #[must_use]
    pub fn column(&self, j: usize) -> &[f64] {
        &self.entries[j * self.n_rows..][..self.n_rows]
    }

    /// Mutable column `j` of the matrix.
    pub(crate) fn column_mut(&mut self, j: usize) -> &mut [f64] {
        &mut self.entries[j * self.n_rows..][..self.n_rows]
    }

    /// Mutable columns `i < j` of the matrix.
    pub(crate) fn two_columns(&mut self, i: usize, j: usize) -> (&mut [f64], &mut [f64]) {
        let (low, high) = self.entries.split_at_mut(j * self.n_rows);
        (&mut low[i * self.n_rows..][..self.n_rows], &mut high[..self.n_rows])
    }

    /// Returns the columns from number `from` to the last.
    #[must_use]
    pub fn columns_from(&self, from: usize) -> Self {
        Self {
            n_rows: self.n_rows,
            n_columns: self.n_columns - from,
            entries: self.entries[from * self.n_rows..].to_vec(),
        }
    }

    /// Returns the transposed matrix, with rows and columns exchanged.
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(self.n_columns, self.n_rows, |i, j| self[(j, i)])
    }

    /// Product A B of two matrices.
    ///
    /// # Panics
    /// If the number of rows of B differs from the number of columns of A.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        assert_eq!(self.n_columns, other.n_rows, "rows of the right factor");
        let mut product = Self::zeros(self.n_rows, other.n_columns);
        for j in 0..other.n_columns {
            let sum = product.column_mut(j);
            for (k, &b) in other.column(j).iter().enumerate() {
                add(sum, b, self.column(k));
            }
        }
        product
    }

    /// Difference A − B of two matrices.
    ///
    /// # Panics
    /// If their sizes differ.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        let sizes = (other.n_rows, other.n_columns);
        assert_eq!((self.n_rows, self.n_columns), sizes, "sizes of both");
        let pairs = self.entries.iter().zip(&other.entries);
        Self { entries: pairs.map(|(a, b)| a - b).collect(), ..*self }
    }

    /// Returns the largest absolute value of an entry; `None` if an entry is not finite.
    pub(crate) fn largest(&self) -> Option<f64> {
        let is_finite = self.entries.iter().all(|x| x.is_finite());
        is_finite.then(|| self.entries.iter().fold(0.0, |l: f64, x| l.max(x.abs())))
    }

    /// Multiplies every entry by a number.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.entries.iter_mut().for_each(|x| *x *= factor);
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;

    fn index(&self, (i, j): (usize, usize)) -> &f64 {
        &self.column(j)[i]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (i, j): (usize, usize)) -> &mut f64 {
        &mut self.column_mut(j)[i]
    }
}

/// Adds a multiple of a vector: y ← y + s x.
pub(crate) fn add(y: &mut [f64], s: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += s * x;
    }
}

/// Returns the scalar product xᵀ y, summed in four partial sums.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (x_four, y_four) = (x.as_chunks::<4>(), y.as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (a, b) in x_four.0.iter().zip(y_four.0) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = x_four.1.iter().zip(y_four.1).map(|(a, b)| a * b).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}
