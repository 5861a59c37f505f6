//! Eigenvalues of a general matrix, by the QR iteration with double shifts of Francis (1961).
//!
//! ```text
//! A ← D⁻¹ A D             D: powers of two that make row i and column i alike in size (Parlett and Reinsch 1969)
//! H = Qᵀ A Q              zero below the first subdiagonal, by reflections
//! H ← Zᵀ H Z              the first column of Z is that of (H − σ₁)(H − σ₂): σ are the eigenvalues of the last two rows
//! ```
//!
//! Both shifts are applied in one step, so that a conjugate pair needs no complex numbers. A subdiagonal entry that is small relative to its
//! neighbours counts as zero and splits H. The eigenvalues of blocks of one and two rows follow from formulas.

use alloc::vec::Vec;
use mbs_core::Real;

/// Largest number of sweeps for each row of a matrix; a matrix has the sweeps of at least ten rows [-]. Two or three sweeps are usual. The
/// limit holds for all eigenvalues together. Where stiff and soft springs act on the same coordinates, the first eigenvalue may need a
/// hundred sweeps, and the others only a few.
const MAX_SWEEPS: usize = 30;
/// Number of sweeps without success after which an exceptional shift breaks a cycle [-]. The number is that of EISPACK's `hqr`.
const STUCK: usize = 10;
/// Largest number of passes of balancing [-]. Three passes are usual.
const MAX_PASSES: usize = 100;
/// A row and its column are scaled if the sum of their entries falls below this fraction of its value [-]. The fraction is that of Parlett and
/// Reinsch (1969).
const WORTH_SCALING: f64 = 0.95;
/// Half of the sum of the two exceptional shifts, and minus their product, relative to the subdiagonal entries [-]. The values are those of
/// EISPACK's `hqr`.
const EXCEPTIONAL: [f64; 2] = [0.75, 0.4375];

/// Returns all eigenvalues [real, imaginary] of an n x n matrix, given column by column; conjugate ones are adjacent. Returns `None` if an
/// entry or an eigenvalue is not finite, or the iteration does not converge.
///
/// Cost: about 10 n³ operations; allocates.
///
/// # Panics
/// If there are not n² entries.
#[must_use]
pub fn eigenvalues<T: Real>(n: usize, a: &[T]) -> Option<Vec<[T; 2]>> {
    assert_eq!(a.len(), n * n, "entries of an n x n matrix");
    if !a.iter().all(|x| x.is_finite()) {
        return None;
    }
    let mut square = Square { n, entries: a.to_vec() };
    let scale = square.scale();
    square.balance();
    square.reduce();
    let mut values = square.francis()?;
    values.iter_mut().flatten().for_each(|x| *x *= scale);
    values.iter().flatten().all(|x| x.is_finite()).then_some(values)
}

/// A square matrix, stored column by column.
struct Square<T> {
    n: usize,
    entries: Vec<T>,
}

impl<T: Real> Square<T> {
    fn at(&self, i: usize, j: usize) -> T {
        self.entries[j * self.n + i]
    }

    fn at_mut(&mut self, i: usize, j: usize) -> &mut T {
        &mut self.entries[j * self.n + i]
    }

    /// Divides the matrix by a power of two so that its entries are at most of order one. Returns the power.
    fn scale(&mut self) -> T {
        let largest = self.entries.iter().fold(T::ZERO, |l, x| l.max(x.abs()));
        let mut scale = T::ONE;
        while largest > T::TWO * scale {
            scale *= T::TWO;
        }
        while largest > T::ZERO && largest < scale {
            scale *= T::HALF;
        }
        self.entries.iter_mut().for_each(|x| *x /= scale);
        scale
    }

    /// Balances rows and columns: scales them until their sums of absolute entries, without the diagonal, are similar. (Squares of small
    /// entries would underflow.)
    fn balance(&mut self) {
        let enough = T::from_f64(WORTH_SCALING);
        for _ in 0..MAX_PASSES {
            let mut is_balanced = true;
            for i in 0..self.n {
                let sizes = |of: &dyn Fn(usize) -> T| {
                    let beside = (0..self.n).filter(|&j| j != i);
                    beside.fold(T::ZERO, |sum, j| sum + of(j).abs())
                };
                let (mut column, mut row) = (sizes(&|j| self.at(j, i)), sizes(&|j| self.at(i, j)));
                if column == T::ZERO || row == T::ZERO {
                    continue;
                }
                let (before, mut f) = (column + row, T::ONE);
                while column < row * T::HALF {
                    (column, row, f) = (column * T::TWO, row * T::HALF, f * T::TWO);
                }
                while column * T::HALF >= row {
                    (column, row, f) = (column * T::HALF, row * T::TWO, f * T::HALF);
                }
                if column + row < enough * before {
                    is_balanced = false;
                    for j in 0..self.n {
                        *self.at_mut(i, j) /= f;
                    }
                    for j in 0..self.n {
                        *self.at_mut(j, i) *= f;
                    }
                }
            }
            if is_balanced {
                break;
            }
        }
    }

    /// Reduces the matrix to H, which is zero below the first subdiagonal.
    fn reduce(&mut self) {
        let n = self.n;
        for k in 0..n.saturating_sub(2) {
            let mut x: Vec<T> = (k + 1..n).map(|i| self.at(i, k)).collect();
            let largest = x[1..].iter().fold(T::ZERO, |l, x| l.max(x.abs()));
            if largest == T::ZERO {
                continue;
            }
            // x ← x − left e₁,   β = 2 / xᵀx;   scaled to the size of x, so that no square underflows
            let largest = largest.max(x[0].abs());
            x.iter_mut().for_each(|x| *x /= largest);
            let square = |x: &[T]| x.iter().fold(T::ZERO, |sum, &x| sum + x * x);
            let left = -with_sign(square(&x).sqrt(), x[0]);
            x[0] -= left;
            let beta = T::TWO / square(&x);

            // H ← (I − β x xᵀ) H
            *self.at_mut(k + 1, k) = left * largest;
            (k + 2..n).for_each(|i| *self.at_mut(i, k) = T::ZERO);
            for j in k + 1..n {
                let sum = x.iter().zip(k + 1..).fold(T::ZERO, |s, (&x, i)| s + x * self.at(i, j));
                x.iter().zip(k + 1..).for_each(|(&x, i)| *self.at_mut(i, j) -= beta * sum * x);
            }

            // H ← H (I − β x xᵀ)
            for i in 0..n {
                let sum = x.iter().zip(k + 1..).fold(T::ZERO, |s, (&x, j)| s + x * self.at(i, j));
                x.iter().zip(k + 1..).for_each(|(&x, j)| *self.at_mut(i, j) -= beta * sum * x);
            }
        }
    }

    /// Computes the eigenvalues of H, from the last rows to the first.
    fn francis(&mut self) -> Option<Vec<[T; 2]>> {
        let norm = self.entries.iter().fold(T::ZERO, |l, x| l.max(x.abs()));
        let tiny = T::EPSILON * T::EPSILON * norm;
        let mut values = Vec::with_capacity(self.n);
        let (mut n_left, mut sweeps, mut n_sweeps) = (self.n, 0_usize, 0);
        while n_left > 0 {
            let last = n_left - 1;
            let low = (1..=last).rev().find(|&i| self.is_split(i, last, tiny)).unwrap_or(0);
            if last - low < 2 {
                if low == last {
                    values.push([self.at(last, last), T::ZERO]);
                } else {
                    values.extend(self.pair(low));
                }
                (n_left, sweeps) = (low, 0);
                continue;
            }
            (sweeps, n_sweeps) = (sweeps + 1, n_sweeps + 1);
            if n_sweeps > MAX_SWEEPS * self.n.max(10) {
                return None;
            }
            self.sweep(low, last, sweeps.is_multiple_of(STUCK));
        }
        Some(values)
    }

    /// Sets the subdiagonal entry of row i to zero if it is a rounding error. Returns whether it did.
    fn is_split(&mut self, i: usize, last: usize, tiny: T) -> bool {
        let mut beside = self.at(i - 1, i - 1).abs() + self.at(i, i).abs();
        if beside == T::ZERO {
            // Without damping the diagonal is zero, so the entry is compared with its neighbours on the subdiagonal.
            let above = if i > 1 { self.at(i - 1, i - 2).abs() } else { T::ZERO };
            beside = if i < last { above + self.at(i + 1, i).abs() } else { above };
        }
        let is_zero = self.at(i, i - 1).abs() <= (T::EPSILON * beside).max(tiny);
        if is_zero {
            *self.at_mut(i, i - 1) = T::ZERO;
        }
        is_zero
    }

    /// Returns the two eigenvalues of rows k and k + 1, each as real and imaginary part: λ = (a + d)/2 ± √((a − d)²/4 + b c).
    fn pair(&self, k: usize) -> [[T; 2]; 2] {
        let (a, d) = (self.at(k, k), self.at(k + 1, k + 1));
        let product = self.at(k, k + 1) * self.at(k + 1, k);
        let half = (a - d) * T::HALF;
        let square = half * half + product;
        let root = square.abs().sqrt();
        if square < T::ZERO {
            return [[d + half, root], [d + half, -root]];
        }
        // λ − d: the larger one without cancellation, the smaller one from their product; then the larger λ from the sum λ₁ + λ₂ = a + d
        let change = half + with_sign(root, half);
        let other = if change == T::ZERO { T::ZERO } else { -product / change };
        [[a - other, T::ZERO], [d + other, T::ZERO]]
    }

    /// Makes one QR sweep, which moves a bulge from the first rows of a block to its last ones.
    fn sweep(&mut self, low: usize, last: usize, is_stuck: bool) {
        let (start, mut x) = self.start(low, last, self.shifts(last, is_stuck));
        for k in start..last {
            let n_rows = if k + 2 <= last { 3 } else { 2 };
            if k > start {
                x = [self.at(k, k - 1), self.at(k + 1, k - 1), T::ZERO];
                if n_rows == 3 {
                    x[2] = self.at(k + 2, k - 1);
                }
            }
            let largest = x.iter().fold(T::ZERO, |l, x| l.max(x.abs()));
            if largest == T::ZERO {
                continue;
            }
            x.iter_mut().for_each(|x| *x /= largest);
            let left = -with_sign((x[0] * x[0] + x[1] * x[1] + x[2] * x[2]).sqrt(), x[0]);
            if k > start {
                *self.at_mut(k, k - 1) = left * largest;
                (1..n_rows).for_each(|i| *self.at_mut(k + i, k - 1) = T::ZERO);
            } else if k > low {
                // (1 − β x₀²) h. Nearly all of x is x₀, so the difference is written without cancellation.
                *self.at_mut(k, k - 1) *= x[0] / left;
            }

            // H ← (I − β x xᵀ) H (I − β x xᵀ),   β = 2 / xᵀx = 1 / (left (left − x₀)) before x₀ ← x₀ − left
            let beta = T::ONE / (left * (left - x[0]));
            x[0] -= left;
            self.reflect(k, (low, last), (beta, &x[..n_rows]));
        }
    }

    /// Returns a, d and b c of the 2 x 2 block [a b; c d] whose eigenvalues are the shifts.
    fn shifts(&self, last: usize, is_stuck: bool) -> [T; 3] {
        let (a, d) = (self.at(last - 1, last - 1), self.at(last, last));
        if is_stuck {
            let size = self.at(last, last - 1).abs() + self.at(last - 1, last - 2).abs();
            let [shift, product] = EXCEPTIONAL.map(T::from_f64);
            let both = d + shift * size;
            return [both, both, -product * size * size];
        }
        [a, d, self.at(last, last - 1) * self.at(last - 1, last)]
    }

    /// Returns the row where the sweep starts, and the first column of (H − σ₁)(H − σ₂) there, divided by its subdiagonal entry.
    fn start(&self, low: usize, last: usize, [a, d, bc]: [T; 3]) -> (usize, [T; 3]) {
        for m in (low..=last - 2).rev() {
            let (h, next, below) = (self.at(m, m), self.at(m + 1, m + 1), self.at(m + 1, m));
            let x = [
                ((h - a) * (h - d) - bc) / below + self.at(m, m + 1),
                (h - a) + (next - d),
                self.at(m + 2, m + 1),
            ];
            if m == low {
                return (m, x);
            }
            // Between two small subdiagonal entries, a sweep that starts here changes the entries to the left only by a rounding error.
            let spoilt = self.at(m, m - 1).abs() * (x[1].abs() + x[2].abs());
            let beside = self.at(m - 1, m - 1).abs() + h.abs() + next.abs();
            if spoilt <= T::EPSILON * x[0].abs() * beside {
                return (m, x);
            }
        }
        unreachable!("a block has three rows or more")
    }

    /// Applies the reflection I − β x xᵀ to the rows and columns from k on, within a block.
    fn reflect(&mut self, k: usize, (low, last): (usize, usize), (beta, x): (T, &[T])) {
        for j in k..=last {
            let sum = x.iter().zip(k..).fold(T::ZERO, |s, (&x, i)| s + x * self.at(i, j));
            x.iter().zip(k..).for_each(|(&x, i)| *self.at_mut(i, j) -= beta * sum * x);
        }
        for i in low..=last.min(k + 3) {
            let sum = x.iter().zip(k..).fold(T::ZERO, |s, (&x, j)| s + x * self.at(i, j));
            x.iter().zip(k..).for_each(|(&x, j)| *self.at_mut(i, j) -= beta * sum * x);
        }
    }
}

/// Returns `size` with the sign of `of`.
fn with_sign<T: Real>(size: T, of: T) -> T {
    if of < T::ZERO { -size } else { size }
}

#[cfg(test)]
mod tests;
