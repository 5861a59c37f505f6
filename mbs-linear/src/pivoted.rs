//! Square matrices in which some directions may have no stiffness.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// A square matrix after elimination with complete pivoting.
pub(crate) struct Pivoted<T> {
    n: usize,
    /// Factors L and U, column by column, in the order of the pivots.
    lu: Vec<T>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    rank: usize,
    /// Diagonal entry for the directions that were not eliminated.
    least: T,
}

impl<T: Real> Pivoted<T> {
    /// Eliminates until the remaining entries are at most `least`.
    pub(crate) fn new(n: usize, lu: Vec<T>, least: T) -> Self {
        let order = || (0..n).collect::<Vec<usize>>();
        let mut new = Self { n, lu, rows: order(), columns: order(), rank: 0, least };
        while new.rank < n && new.eliminate() {
            new.rank += 1;
        }
        // The remaining rows and columns are paired so that the directions keep their order.
        for k in new.rank..n {
            let first = |order: &[usize]| (k..n).min_by_key(|&i| order[i]).unwrap_or(k);
            let (row, column) = (first(&new.rows), first(&new.columns));
            new.swap(k, row, column);
        }
        new
    }

    /// Exchanges a row and a column with those at position `k`.
    fn swap(&mut self, k: usize, row: usize, column: usize) {
        let n = self.n;
        for j in 0..n {
            self.lu.swap(j * n + k, j * n + row);
        }
        for i in 0..n {
            self.lu.swap(k * n + i, column * n + i);
        }
        self.rows.swap(k, row);
        self.columns.swap(k, column);
    }

    /// Eliminates with the largest remaining pivot, if it is large enough. Returns whether it was large enough.
    fn eliminate(&mut self) -> bool {
        let (n, rank) = (self.n, self.rank);
        let (mut pivot, mut size) = ((rank, rank), T::ZERO);
        for j in rank..n {
            for i in rank..n {
                if self.lu[j * n + i].abs() > size {
                    (pivot, size) = ((i, j), self.lu[j * n + i].abs());
                }
            }
        }
        if !(size > self.least) {
            return false;
        }
        self.swap(rank, pivot.0, pivot.1);
        for i in rank + 1..n {
            self.lu[rank * n + i] = self.lu[rank * n + i] / self.lu[rank * n + rank];
            for j in rank + 1..n {
                let part = self.lu[rank * n + i] * self.lu[j * n + rank];
                self.lu[j * n + i] -= part;
            }
        }
        true
    }

    /// Solves A x = b, where a direction that was not eliminated has the stiffness `least`.
    pub(crate) fn solve(&self, b: &[T]) -> Vec<T> {
        let (n, rank) = (self.n, self.rank);
        let mut y: Vec<T> = self.rows.iter().map(|&i| b[i]).collect();
        for k in 0..rank {
            for i in k + 1..n {
                let part = self.lu[k * n + i] * y[k];
                y[i] -= part;
            }
        }
        for k in (0..n).rev() {
            let is_alone = k >= rank && self.rows[k] == self.columns[k] && self.least > T::ZERO;
            let pivot = if is_alone { self.least } else { self.lu[k * n + k] };
            y[k] = if k < rank || is_alone { y[k] / pivot } else { T::ZERO };
            for i in 0..k.min(rank) {
                let part = self.lu[k * n + i] * y[k];
                y[i] -= part;
            }
        }
        let mut x = vec![T::ZERO; n];
        self.columns.iter().zip(y).for_each(|(&j, y)| x[j] = y);
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_without_stiffness_has_the_least_one() {
        // Columns (0, 2, 0), (1, 0, 0), (0, 0, 0): x = 3 / 2 and y = 4.
        let a = vec![0.0, 2.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1e-20];
        let matrix = Pivoted::new(3, a, 0.25);
        assert_eq!(matrix.solve(&[4.0, 3.0, 5.0]), [1.5, 4.0, 20.0]);
        // The middle direction is not eliminated.
        let a = vec![0.0, 0.0, 2.0, 0.0, 1e-20, 0.0, 1.0, 0.0, 0.0];
        let matrix = Pivoted::new(3, a, 0.25);
        assert_eq!(matrix.solve(&[4.0, 9.0, 6.0]), [3.0, 36.0, 4.0]);
    }
}
