//! Factors of x − J for a real or complex number x.

use super::coefficients::Coefficients;
use super::complex::{Complex, Number};
use crate::Real;
use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;

/// The two matrices of an iteration, γ/h − J and (α + iβ)/h − J.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Matrices<T> {
    pub(super) real: Factor<T, T>,
    pub(super) complex: Factor<T, Complex<T>>,
}

impl<T: Real> Matrices<T> {
    pub(super) fn new(n: usize, leading: usize) -> Self {
        Self { real: Factor::new(n, leading), complex: Factor::new(n, leading) }
    }

    /// Factors both matrices for a step; returns `true` when both are regular.
    pub(super) fn factor(&mut self, of: &Coefficients<T>, h: T, jacobian: &[T]) -> bool {
        let Complex { re, im } = of.complex;
        self.real.factor(of.real / h, jacobian)
            && self.complex.factor(Complex::new(re / h, im / h), jacobian)
    }
}

/// Factors of P (x − J) = L U, stored row by row in one array.
///
/// The leading unknowns, whose rates depend little on each other, are eliminated without row exchanges, and zeros in their rows are
/// skipped. The other unknowns are eliminated with the largest pivot in their column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Factor<T, N> {
    n: usize,
    leading: usize,
    entries: Vec<N>,
    /// The row that was moved to each place.
    pivots: Vec<usize>,
    /// Work list during an elimination: the columns in which a row is not zero.
    columns: Vec<usize>,
    scalar: PhantomData<T>,
}

impl<T: Real, N: Number<T>> Factor<T, N> {
    pub(super) fn new(n: usize, leading: usize) -> Self {
        Self {
            n,
            leading: leading.min(n),
            entries: vec![N::of(T::ZERO); n * n],
            pivots: (0..n).collect(),
            columns: Vec::with_capacity(n),
            scalar: PhantomData,
        }
    }

    /// Factors x − J; returns `true` when all pivots are finite and not zero.
    ///
    /// Cost, with l leading unknowns: (n − l)³/3 products for the other unknowns. The leading unknowns cost less than (n − l)² l, when the
    /// rate of each depends on few unknowns.
    pub(super) fn factor(&mut self, x: N, jacobian: &[T]) -> bool {
        let n = self.n;
        for (entry, &slope) in self.entries.iter_mut().zip(jacobian) {
            *entry = N::of(-slope);
        }
        for k in 0..n {
            self.entries[k * n + k] = x - N::of(jacobian[k * n + k]);
        }
        (0..n).all(|k| {
            if k >= self.leading {
                self.exchange(k);
            }
            let pivot = self.entries[k * n + k].size();
            let is_sound = pivot > T::ZERO && pivot.is_finite();
            if is_sound {
                self.eliminate(k);
            }
            is_sound
        })
    }

    /// Moves the row with the largest entry of column k to place k.
    fn exchange(&mut self, k: usize) {
        let n = self.n;
        let mut largest = (k, T::ZERO);
        for i in k..n {
            let size = self.entries[i * n + k].size();
            if size > largest.1 {
                largest = (i, size);
            }
        }
        self.pivots[k] = largest.0;
        if largest.0 > k {
            let (above, below) = self.entries.split_at_mut(largest.0 * n);
            above[k * n..][..n].swap_with_slice(&mut below[..n]);
        }
    }

    /// Subtracts multiples of row k from the rows below it.
    fn eliminate(&mut self, k: usize) {
        let n = self.n;
        let (above, below) = self.entries.split_at_mut((k + 1) * n);
        let row = &above[k * n..][..n];
        let is_sparse = k < self.leading;
        if is_sparse {
            self.columns.clear();
            self.columns.extend((k + 1..n).filter(|&j| row[j].size() > T::ZERO));
        }
        for other in below.chunks_exact_mut(n) {
            if !(other[k].size() > T::ZERO) {
                continue;
            }
            let share = other[k] / row[k];
            other[k] = share;
            if is_sparse {
                for &j in &self.columns {
                    other[j] = other[j] - share * row[j];
                }
            } else {
                for (entry, &above) in other[k + 1..].iter_mut().zip(&row[k + 1..]) {
                    *entry = *entry - share * above;
                }
            }
        }
    }

    /// Replaces b by (x − J)⁻¹ b. Cost: n² products.
    pub(super) fn solve(&self, b: &mut [N]) {
        let n = self.n;
        for k in self.leading..n {
            b.swap(k, self.pivots[k]);
        }
        for i in 1..n {
            let row = &self.entries[i * n..][..i];
            b[i] = row.iter().zip(&*b).fold(b[i], |rest, (&entry, &b)| rest - entry * b);
        }
        for i in (0..n).rev() {
            let row = &self.entries[i * n..][..n];
            let known = row[i + 1..].iter().zip(&b[i + 1..]);
            b[i] = known.fold(b[i], |rest, (&entry, &b)| rest - entry * b) / row[i];
        }
    }
}
