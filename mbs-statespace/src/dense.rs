//! Dense matrices for the independent coordinates: a symmetric one for mbs-core's solver, and A = L U with row pivoting.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::dense::front::column;
use mbs_core::{BlockSource, Cliques, Real};

/// A symmetric positive definite matrix of size f. mbs-core's solver gets it as one element that couples all unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Symmetric<T> {
    clique: Vec<u32>,
    /// The lower triangle, packed by columns.
    values: Vec<T>,
}

impl<T: Real> Symmetric<T> {
    pub(crate) fn new(size: usize) -> Self {
        let clique = (0..size).map(|i| u32::try_from(i).unwrap_or(u32::MAX)).collect();
        Self { clique, values: vec![T::ZERO; column(size, size)] }
    }

    pub(crate) fn clear(&mut self) {
        self.values.fill(T::ZERO);
    }

    /// Returns the entry at (row, col), where row >= col.
    #[inline]
    pub(crate) fn at(&mut self, row: usize, col: usize) -> &mut T {
        &mut self.values[column(self.clique.len(), col) + row - col]
    }
}

impl<T: Real> Cliques for Symmetric<T> {
    fn n_unknowns(&self) -> usize {
        self.clique.len()
    }
    fn n_elements(&self) -> usize {
        1
    }
    fn clique(&self, _element: usize) -> &[u32] {
        &self.clique
    }
}

impl<T: Real> BlockSource<T> for Symmetric<T> {
    fn write_block(&self, _element: usize, block: &mut [T]) {
        block.copy_from_slice(&self.values);
    }
    fn write_residual(&self, _element: usize, residual: &mut [T]) {
        residual.fill(T::ZERO);
    }
}

/// A square matrix of size f, then its factors, row by row.
#[derive(Debug, Clone)]
pub(crate) struct General<T> {
    size: usize,
    pub(crate) values: Vec<T>,
    /// For each row, the row with which it was swapped.
    swaps: Vec<usize>,
}

impl<T: Real> General<T> {
    pub(crate) fn new(size: usize) -> Self {
        Self { size, values: vec![T::ZERO; size * size], swaps: vec![0; size] }
    }

    /// Factors P A = L U in place. Cost: f^3 / 3 products.
    ///
    /// # Errors
    /// The index of the first column without a pivot.
    pub(crate) fn factor(&mut self) -> Result<(), usize> {
        let n = self.size;
        for k in 0..n {
            let mut best = k;
            for i in k + 1..n {
                if self.values[i * n + k].abs() > self.values[best * n + k].abs() {
                    best = i;
                }
            }
            self.swaps[k] = best;
            if best != k {
                let (above, below) = self.values.split_at_mut(best * n);
                above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
            }
            let pivot = self.values[k * n + k];
            if !(pivot.abs() > T::ZERO && pivot.is_finite()) {
                return Err(k);
            }
            let (above, below) = self.values.split_at_mut((k + 1) * n);
            let pivot_row = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                let l = row[k] / pivot;
                row[k] = l;
                for j in k + 1..n {
                    row[j] -= l * pivot_row[j];
                }
            }
        }
        Ok(())
    }

    /// Solves in place: x = A^-1 x.
    pub(crate) fn solve(&self, x: &mut [T]) {
        let n = self.size;
        for (k, &swap) in self.swaps.iter().enumerate() {
            x.swap(k, swap);
        }
        for i in 0..n {
            let row = &self.values[i * n..i * n + i];
            x[i] = row.iter().zip(&x[..i]).fold(x[i], |s, (&l, &x)| s - l * x);
        }
        for i in (0..n).rev() {
            let row = &self.values[i * n..(i + 1) * n];
            let sum = row[i + 1..].iter().zip(&x[i + 1..]).fold(x[i], |s, (&u, &x)| s - u * x);
            x[i] = sum / row[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::General;

    #[test]
    fn a_matrix_that_needs_swaps_is_solved() {
        // [0 2 1; 1 1 0; 3 0 1] x = [7; 3; 6]: x = [1; 2; 3]
        let mut a = General::<f64>::new(3);
        a.values.copy_from_slice(&[0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, 1.0]);
        a.factor().unwrap();
        let mut x = [7.0, 3.0, 6.0];
        a.solve(&mut x);
        assert!(x.iter().zip([1.0, 2.0, 3.0]).all(|(x, y)| (x - y).abs() < 1e-14));
    }
}
