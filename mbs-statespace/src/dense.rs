//! Small dense matrices: A = L D L^T without pivoting for symmetric ones, L U with row pivoting for others.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// A symmetric matrix of size f, then its factors. The lower triangle is used, row by row.
#[derive(Debug, Clone)]
pub(crate) struct Symmetric<T> {
    size: usize,
    values: Vec<T>,
}

impl<T: Real> Symmetric<T> {
    pub(crate) fn new(size: usize) -> Self {
        Self { size, values: vec![T::ZERO; size * size] }
    }

    pub(crate) fn clear(&mut self) {
        self.values.fill(T::ZERO);
    }

    /// The entry at (row, column), row >= column.
    #[inline]
    pub(crate) fn at(&mut self, row: usize, column: usize) -> &mut T {
        &mut self.values[row * self.size + column]
    }

    /// A = L D L^T in place. Cost: f^3 / 6 products.
    ///
    /// # Errors
    /// The first pivot that is not above the rounding of its diagonal entry, and its place.
    pub(crate) fn factor(&mut self) -> Result<(), (usize, T)> {
        let n = self.size;
        for i in 0..n {
            let (above, row) = self.values.split_at_mut(i * n);
            let diagonal = row[i];
            let mut pivot = diagonal;
            // Row i holds L D first; l_ij = (a_ij - sum_k l_jk d_k l_ik) / d_j.
            for j in 0..i {
                let other = &above[j * n..j * n + j];
                let sum = other.iter().zip(&row[..j]).fold(row[j], |s, (&l, &ld)| s - l * ld);
                row[j] = sum;
            }
            for j in 0..i {
                let l = row[j] / above[j * n + j];
                pivot -= l * row[j];
                row[j] = l;
            }
            if !(pivot > diagonal.abs() * T::EPSILON && pivot.is_finite()) {
                return Err((i, pivot));
            }
            row[i] = pivot;
        }
        Ok(())
    }

    /// x = A^-1 x.
    pub(crate) fn solve(&self, x: &mut [T]) {
        let n = self.size;
        for i in 0..n {
            let row = &self.values[i * n..i * n + i];
            x[i] = row.iter().zip(&x[..i]).fold(x[i], |s, (&l, &x)| s - l * x);
        }
        for i in 0..n {
            x[i] /= self.values[i * n + i];
        }
        for i in (0..n).rev() {
            let value = x[i];
            let row = &self.values[i * n..i * n + i];
            for (x, &l) in x[..i].iter_mut().zip(row) {
                *x -= l * value;
            }
        }
    }
}

/// A matrix of size f, then its factors, row by row.
#[derive(Debug, Clone)]
pub(crate) struct General<T> {
    size: usize,
    pub(crate) values: Vec<T>,
    /// The row that was swapped with each row.
    swaps: Vec<usize>,
}

impl<T: Real> General<T> {
    pub(crate) fn new(size: usize) -> Self {
        Self { size, values: vec![T::ZERO; size * size], swaps: vec![0; size] }
    }

    /// P A = L U in place. Cost: f^3 / 3 products.
    ///
    /// # Errors
    /// The first column without a pivot.
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

    /// x = A^-1 x.
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
    use super::{General, Symmetric};

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

    #[test]
    fn a_matrix_done_by_hand_is_solved() {
        // [4 2; 2 3] x = [10; 9]: x = [1.5; 2]
        let mut a = Symmetric::<f64>::new(2);
        (*a.at(0, 0), *a.at(1, 0), *a.at(1, 1)) = (4.0, 2.0, 3.0);
        a.factor().unwrap();
        let mut x = [10.0, 9.0];
        a.solve(&mut x);
        assert!((x[0] - 1.5).abs() < 1e-15 && (x[1] - 2.0).abs() < 1e-15);
    }

    #[test]
    fn an_indefinite_matrix_is_refused_at_its_row() {
        let mut a = Symmetric::<f64>::new(2);
        (*a.at(0, 0), *a.at(1, 0), *a.at(1, 1)) = (1.0, 2.0, 3.0);
        assert_eq!(a.factor().map_err(|(i, _)| i), Err(1));
    }
}
