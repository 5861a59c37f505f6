//! Factorisation of a mass matrix as Lᵀ D L. L has entries only between columns on a common path to the ground [Featherstone 2005].

use super::OwnFreedoms;
use super::columns::NONE;
use crate::space::Space;
use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;
use mbs_core::Real;

/// Largest pivot that counts as no inertia, relative to the diagonal entry and in units of machine precision [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

impl<T: Real, S: Space<T>> OwnFreedoms<T, S> {
    /// Replaces a mass matrix by its factors: D on the diagonal, and L below it in the order of the tree.
    ///
    /// Cost: of order (number of freedoms) × (depth of the tree)²; no allocation after the first call.
    ///
    /// # Errors
    /// Index of a link whose joint moves no inertia.
    ///
    /// # Panics
    /// If the length of `mass` is not the square of the number of freedoms.
    pub fn factor(&mut self, mass: &mut [T]) -> Result<(), usize> {
        let n = self.columns.len();
        assert_eq!(mass.len(), n * n, "numbers of the mass matrix");
        if self.above.len() < n {
            self.relate();
        }
        for (k, least) in self.least.iter_mut().enumerate() {
            *least = mass[k * n + k] * T::EPSILON * T::from_f64(ROUNDINGS);
        }
        for c in (0..n).rev() {
            let k = self.columns[c].number as usize;
            let pivot = mass[k * n + k];
            if !(pivot > self.least[k]) {
                let link = self.links.iter().position(|link| link.columns.contains(&c));
                return Err(link.unwrap_or(0));
            }
            let inverse = T::ONE / pivot;
            // elimination of column k: M_ij −= M_ki M_kj / D_k for i, j on the path to the ground, L_ki = M_ki / D_k
            for (place, &i) in self.above[c].iter().enumerate() {
                let factor = mass[k * n + i as usize] * inverse;
                for &j in &self.above[c][place..] {
                    let x = mass[k * n + j as usize];
                    mass[i as usize * n + j as usize] -= factor * x;
                }
                mass[k * n + i as usize] = factor;
            }
        }
        Ok(())
    }

    /// Finds for each column the columns that are on a common path to the ground with it.
    fn relate(&mut self) {
        let n = self.columns.len();
        (self.above, self.below) = (vec![Vec::new(); n], vec![Vec::new(); n]);
        for c in 0..n {
            let mut up = self.columns[c].up;
            while up != NONE {
                self.above[c].push(self.columns[up as usize].number);
                self.below[up as usize].push(self.columns[c].number);
                up = self.columns[up as usize].up;
            }
        }
        for c in 0..n {
            let related =
                self.above[c].iter().chain(&self.below[c]).chain([&self.columns[c].number]);
            let ends = related.fold([n, 0], |[least, most], &k| {
                [least.min(k as usize), most.max(k as usize + 1)]
            });
            self.related.push(ends[0]..ends[1]);
        }
    }

    /// Replaces a square X by M⁻¹ X, with the factors of M. Entries of X between freedoms that are not on a common path to the ground must
    /// be zero. Derivatives of efforts and the identity have this property.
    ///
    /// Cost: of order 2 × (number of freedoms)² × (depth of the tree); no allocation after the first call.
    ///
    /// # Panics
    /// If the length of `x` is not the square of the number of freedoms.
    pub fn solve(&mut self, factors: &[T], x: &mut [T]) {
        let n = self.columns.len();
        assert_eq!(x.len(), n * n, "numbers of a square of freedoms");
        self.solve_half((factors, true), x);
        let mut sum = core::mem::take(&mut self.row);
        for c in 0..n {
            let k = self.columns[c].number as usize;
            // forward substitution: x_k ← x_k / D_k − Σ L_kj x_j over the path to the ground
            let scale = T::ONE / factors[k * n + k];
            sum.clear();
            sum.extend(row(x, n, k).iter().map(|&x| x * scale));
            let above = self.above[c].iter().map(|&j| (j as usize, factors[k * n + j as usize]));
            subtract((x, n, 0), above, &mut sum);
            row_mut(x, n, k).copy_from_slice(&sum);
        }
        self.row = sum;
    }

    /// Writes J M⁻¹ Jᵀ with the factors of M, for `width` rows J. On return `columns` contains L⁻ᵀ Jᵀ.
    ///
    /// Cost: of order (number of rows) × (number of freedoms) × (depth of the tree + number of rows); no allocation.
    ///
    /// # Panics
    /// If the lengths of `columns` and `rows` differ, or if the length of `mobility` is not the square of the number of rows.
    pub fn write_mobility(
        &mut self,
        factors: &[T],
        width: usize,
        (rows, columns): (&[T], &mut [T]),
        mobility: &mut [T],
    ) {
        let n = self.columns.len();
        let sizes = [rows.len(), columns.len(), mobility.len()];
        assert_eq!(sizes, [width * n, width * n, width * width], "sizes of J");
        for (i, row) in rows.chunks_exact(n.max(1)).enumerate() {
            for (k, &x) in row.iter().enumerate() {
                columns[k * width + i] = x;
            }
        }
        self.solve_half((factors, false), columns);
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

    /// Replaces `x` by L⁻ᵀ x. In a square matrix, the entries outside of the related columns are zero and are skipped.
    fn solve_half(&mut self, (factors, is_square): (&[T], bool), x: &mut [T]) {
        let n = self.columns.len();
        assert_eq!(x.len() % n.max(1), 0, "rows of freedoms");
        let mut sum = core::mem::take(&mut self.row);
        for c in (0..n).rev() {
            let k = self.columns[c].number as usize;
            let width = x.len() / n;
            let Range { start, end } = if is_square { self.related[c].clone() } else { 0..width };
            // back substitution: x_k ← x_k − Σ L_jk x_j over the subtree
            sum.clear();
            sum.extend_from_slice(&row(x, n, k)[start..end]);
            let below = self.below[c].iter().map(|&j| (j as usize, factors[j as usize * n + k]));
            subtract((x, n, start), below, &mut sum);
            row_mut(x, n, k)[start..end].copy_from_slice(&sum);
        }
        self.row = sum;
    }
}

fn row<T>(x: &[T], n: usize, k: usize) -> &[T] {
    let width = x.len() / n;
    &x[k * width..][..width]
}

fn row_mut<T>(x: &mut [T], n: usize, k: usize) -> &mut [T] {
    let width = x.len() / n;
    &mut x[k * width..][..width]
}

/// Subtracts rows of `x`, each times its factor, from a sum, beginning at a column. Four rows are subtracted in one pass, so that the sum
/// is read and written once for four rows.
#[inline(always)]
fn subtract<T: Real>(
    (x, n, start): (&[T], usize, usize),
    mut terms: impl ExactSizeIterator<Item = (usize, T)>,
    sum: &mut [T],
) {
    while terms.len() >= 4 {
        let mut next =
            || terms.next().map(|(k, factor)| (&row(x, n, k)[start..][..sum.len()], factor));
        let [Some((a, f)), Some((b, g)), Some((c, h)), Some((d, i))] =
            [next(), next(), next(), next()]
        else {
            return;
        };
        for (k, sum) in sum.iter_mut().enumerate() {
            *sum -= f * a[k] + g * b[k] + h * c[k] + i * d[k];
        }
    }
    for (k, factor) in terms {
        for (sum, &x) in sum.iter_mut().zip(&row(x, n, k)[start..]) {
            *sum -= factor * x;
        }
    }
}
