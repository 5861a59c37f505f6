//! A mass matrix as Lᵀ D L, with L as sparse as the tree: only columns on one way to the ground meet [Featherstone 2005].

use super::OwnFreedoms;
use super::columns::NONE;
use crate::space::Space;
use mbs_core::Real;

/// Pivot that is no inertia, in units of rounding of the diagonal [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Replaces a mass matrix by D on its diagonal, and L below it in the order of the tree.
    ///
    /// Cost: freedoms times the square of the depth; no allocation.
    ///
    /// # Errors
    /// The link whose joint meets no inertia.
    ///
    /// # Panics
    /// If `mass` has not the square of the freedoms.
    pub fn factor(&mut self, mass: &mut [T]) -> Result<(), usize> {
        let n = self.number.len();
        assert_eq!(mass.len(), n * n, "numbers of the mass matrix");
        for (k, least) in self.least.iter_mut().enumerate() {
            *least = mass[k * n + k] * T::EPSILON * T::from_f64(ROUNDINGS);
        }
        for c in (0..n).rev() {
            let k = self.number[c] as usize;
            let pivot = mass[k * n + k];
            if !(pivot > self.least[k]) {
                let holds = |columns: &core::ops::Range<usize>| columns.contains(&c);
                return Err(self.of_link.iter().position(holds).unwrap_or(0));
            }
            let inverse = T::ONE / pivot;
            let mut i = self.up[c];
            while i != NONE {
                let row = self.number[i as usize] as usize;
                let factor = mass[k * n + row] * inverse;
                let mut j = i;
                while j != NONE {
                    let column = self.number[j as usize] as usize;
                    let x = mass[k * n + column];
                    mass[row * n + column] -= factor * x;
                    j = self.up[j as usize];
                }
                mass[k * n + row] = factor;
                i = self.up[i as usize];
            }
        }
        Ok(())
    }

    /// Replaces the columns of `x`, which has a row for each freedom, by M⁻¹ times them, by the factors of M.
    ///
    /// Cost: twice the columns, freedoms and depth multiplied; no allocation.
    ///
    /// # Panics
    /// If `x` has not a row for each freedom.
    pub fn solve(&self, factors: &[T], x: &mut [T]) {
        let n = self.number.len();
        assert_eq!(x.len() % n.max(1), 0, "rows of freedoms");
        self.solve_half(factors, x);
        let width = x.len() / n.max(1);
        for (k, row) in x.chunks_exact_mut(width.max(1)).enumerate() {
            let inverse = T::ONE / factors[k * n + k];
            row.iter_mut().for_each(|x| *x *= inverse);
        }
        for c in 0..n {
            let k = self.number[c] as usize;
            let mut j = self.up[c];
            while j != NONE {
                let other = self.number[j as usize] as usize;
                subtract(x, (k, other), (factors[k * n + other], width));
                j = self.up[j as usize];
            }
        }
    }

    /// Writes J M⁻¹ Jᵀ by the factors of M, for rows J; on return `columns` has L⁻ᵀ Jᵀ.
    ///
    /// Cost: rows times freedoms times depth and rows; no allocation.
    ///
    /// # Panics
    /// If `columns` is not as long as the rows, or `mobility` not the square of their number.
    pub fn write_mobility(
        &self,
        factors: &[T],
        (rows, columns): (&[T], &mut [T]),
        mobility: &mut [T],
    ) {
        let n = self.number.len();
        let width = rows.len() / n.max(1);
        assert_eq!((columns.len(), mobility.len()), (rows.len(), width * width), "sizes of J");
        for (i, row) in rows.chunks_exact(n.max(1)).enumerate() {
            for (k, &x) in row.iter().enumerate() {
                columns[k * width + i] = x;
            }
        }
        self.solve_half(factors, columns);
        mobility.fill(T::ZERO);
        for (k, column) in columns.chunks_exact(width.max(1)).enumerate() {
            let inverse = T::ONE / factors[k * n + k];
            for (row, &x) in mobility.chunks_exact_mut(width).zip(column) {
                for (to, &y) in row.iter_mut().zip(column) {
                    *to += x * inverse * y;
                }
            }
        }
    }

    /// Replaces the columns of `x` by L⁻ᵀ times them.
    fn solve_half(&self, factors: &[T], x: &mut [T]) {
        let n = self.number.len();
        let width = x.len() / n.max(1);
        for c in (0..n).rev() {
            let k = self.number[c] as usize;
            let mut j = self.up[c];
            while j != NONE {
                let other = self.number[j as usize] as usize;
                subtract(x, (other, k), (factors[k * n + other], width));
                j = self.up[j as usize];
            }
        }
    }
}

/// Subtracts `factor` times one row from another.
#[inline(always)]
fn subtract<T: Real>(x: &mut [T], (to, from): (usize, usize), (factor, width): (T, usize)) {
    let (to, from) = if to < from {
        let (before, behind) = x.split_at_mut(from * width);
        (&mut before[to * width..][..width], &behind[..width])
    } else {
        let (before, behind) = x.split_at_mut(to * width);
        (&mut behind[..width], &before[from * width..][..width])
    };
    for (to, &from) in to.iter_mut().zip(from) {
        *to -= factor * from;
    }
}
