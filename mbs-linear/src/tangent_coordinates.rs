//! Independent coordinates at a position, from an orthonormal split of the coordinates by the Jacobian there.
//!
//! ```text
//! J^T P = [ Q1  Q2 ] [ R11  R12 ]      Householder QR with column pivoting on rows of unit length
//!                    [  0    0  ]
//! q = q0 + B z + Q1 y,   B = Q2 L^-T,   Q2^T M Q2 = L L^T:   z are free, y closes the constraints
//! z = L^T Q2^T (q - q0),   z' = L^T Q2^T q',   z'' = L^T Q2^T q'',      B^T M B = 1
//! ```
//!
//! Coordinates are scaled by their sizes: q = S x, where S is the scene's length for points and one for directions. The formulas are in x,
//! with J S and S M S. So the split does not depend on the unit of length.
//!
//! The inertia is a unit matrix. So the stiffness of conservative forces is symmetric, and eigenvalues are well conditioned.

use crate::pivoted::Pivoted;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// The split at one position; matrices are stored column by column.
#[derive(Debug, Clone)]
pub(crate) struct TangentCoordinates<T> {
    n: usize,
    /// Independent rows in the order of their pivots, and the length of each row.
    rows: Vec<usize>,
    lengths: Vec<T>,
    /// Orthogonal matrix Q = (Q1, Q2), n x n.
    q: Vec<T>,
    /// Upper triangle R11, r x r.
    r: Vec<T>,
    /// Lower triangle L, f x f.
    l: Vec<T>,
    /// Sizes S of the coordinates.
    sizes: Vec<T>,
    /// Basis S B, n x f.
    pub(crate) basis: Vec<T>,
    /// Derivatives dx/dz (f x f) of chosen coordinates x that replace z; the basis is then S B (dx/dz)^-1.
    chosen: Option<Vec<T>>,
}

/// Inertia, relative to the largest one, up to which a direction counts as without inertia [-]: a rounding error. Chosen, not tuned.
const NO_INERTIA: f64 = 1e-13;

impl<T: Real> TangentCoordinates<T> {
    /// Splits the coordinates by `jacobian`, given row by row (m rows of n); `mass` multiplies a vector of n by M. Rows of velocities,
    /// marked in `is_late`, are eliminated after all others. So where they depend on rows of positions, the rows of positions are the
    /// independent ones.
    ///
    /// Fails with the index of a freedom without inertia.
    pub(crate) fn new(
        sizes: &[T],
        (mut jacobian, is_late): (Vec<T>, impl Fn(usize) -> bool),
        mut mass: impl FnMut(&[T]) -> Vec<T>,
    ) -> Result<Self, usize> {
        let n = sizes.len();
        let scaled = |x: &[T]| -> Vec<T> { x.iter().zip(sizes).map(|(&x, &s)| x * s).collect() };
        for row in jacobian.chunks_exact_mut(n.max(1)) {
            row.copy_from_slice(&scaled(row));
        }
        let (rows, lengths, q, r) = factor(n, &mut jacobian, is_late);
        let rank = rows.len();
        let f = n - rank;
        let mut l = vec![T::ZERO; f * f];
        for j in 0..f {
            let product = scaled(&mass(&scaled(column(&q, n, rank + j))));
            for i in j..f {
                l[j * f + i] = dot(column(&q, n, rank + i), &product);
            }
        }
        cholesky(&mut l, f)?;
        let mut basis = q[n * rank..].to_vec();
        // B L^T = Q2, column by column: B_j = (Q2_j - sum_(k<j) L_jk B_k) / L_jj
        for j in 0..f {
            for k in 0..j {
                let factor = l[k * f + j];
                for i in 0..n {
                    let part = factor * basis[k * n + i];
                    basis[j * n + i] -= part;
                }
            }
            let inverse = T::ONE / l[j * f + j];
            basis[j * n..(j + 1) * n].iter_mut().for_each(|x| *x *= inverse);
        }
        for column in basis.chunks_exact_mut(n.max(1)) {
            column.copy_from_slice(&scaled(column));
        }
        let (sizes, chosen) = (sizes.to_vec(), None);
        Ok(Self { n, rows, lengths, q, r, l, sizes, basis, chosen })
    }

    /// Replaces z by coordinates x, given by a regular matrix dx/dz, f x f.
    pub(crate) fn choose(&mut self, slopes: Vec<T>) {
        let (n, f) = (self.n, self.n_freedoms());
        let matrix = Pivoted::new(f, slopes.clone(), T::ZERO);
        let (mut unit, mut basis) = (vec![T::ZERO; f], vec![T::ZERO; n * f]);
        for (j, to) in basis.chunks_exact_mut(n.max(1)).enumerate() {
            unit[j] = T::ONE;
            for (k, z) in matrix.solve(&unit).into_iter().enumerate() {
                to.iter_mut().zip(self.direction(k)).for_each(|(to, &b)| *to += b * z);
            }
            unit[j] = T::ZERO;
        }
        (self.basis, self.chosen) = (basis, Some(slopes));
    }

    /// Number of freedoms f.
    pub(crate) fn n_freedoms(&self) -> usize {
        self.n - self.rows.len()
    }

    /// Subtracts from x the smallest d with J0 d = b on the independent rows of the Jacobian J0.
    pub(crate) fn correct(&self, b: &[T], x: &mut [T]) {
        let rank = self.rows.len();
        let mut y = vec![T::ZERO; rank];
        for i in 0..rank {
            let mut sum = b[self.rows[i]] / self.lengths[i];
            for k in 0..i {
                sum -= self.r[i * rank + k] * y[k];
            }
            y[i] = sum / self.r[i * rank + i];
        }
        for (k, &y) in y.iter().enumerate() {
            for (x, (&q, &size)) in
                x.iter_mut().zip(column(&self.q, self.n, k).iter().zip(&self.sizes))
            {
                *x -= q * size * y;
            }
        }
    }

    /// Returns z of a vector q of n numbers, L^T Q2^T S^-1 q, or the chosen x.
    pub(crate) fn reduce(&self, q: &[T]) -> Vec<T> {
        let (rank, f) = (self.rows.len(), self.n_freedoms());
        let x: Vec<T> = q.iter().zip(&self.sizes).map(|(&q, &size)| q / size).collect();
        let e: Vec<T> = (0..f).map(|j| dot(column(&self.q, self.n, rank + j), &x)).collect();
        let z = (0..f).map(|j| (j..f).fold(T::ZERO, |sum, i| sum + self.l[j * f + i] * e[i]));
        let Some(slopes) = &self.chosen else { return z.collect() };
        let mut x = vec![T::ZERO; f];
        for (z, slopes) in z.zip(slopes.chunks_exact(f.max(1))) {
            x.iter_mut().zip(slopes).for_each(|(x, &slope)| *x += slope * z);
        }
        x
    }

    /// Direction of a freedom in the coordinates: a column of S B.
    pub(crate) fn direction(&self, freedom: usize) -> &[T] {
        column(&self.basis, self.n, freedom)
    }
}

fn column<T>(a: &[T], n: usize, j: usize) -> &[T] {
    &a[j * n..(j + 1) * n]
}

fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
}

/// Returns the independent rows with their lengths, Q and R11. The rows that are not `is_late` are first. A row depends on the others if
/// elimination makes it shorter than max(n, m) EPSILON^(2/3) times the largest row.
fn factor<T: Real>(
    n: usize,
    jacobian: &mut [T],
    is_late: impl Fn(usize) -> bool,
) -> (Vec<usize>, Vec<T>, Vec<T>, Vec<T>) {
    let m = jacobian.len() / n.max(1);
    let mut order: Vec<usize> = (0..m).collect();
    order.sort_by_key(|&row| is_late(row));
    let mut end = order.partition_point(|&row| !is_late(row));
    let mut lengths = vec![T::ONE; m];
    for (row, length) in jacobian.chunks_exact_mut(n.max(1)).zip(&mut lengths) {
        let size = dot(row, row).sqrt();
        if size > T::ZERO {
            *length = size;
            row.iter_mut().for_each(|x| *x /= size);
        }
    }
    let third = cube_root(T::EPSILON.to_f64());
    let tolerance = T::from_f64(n.max(m) as f64 * third * third);
    let (mut largest, mut rank) = (T::ZERO, 0);
    let mut q = vec![T::ZERO; n * n];
    (0..n).for_each(|i| q[i * n + i] = T::ONE);
    while rank < n {
        let rest = |row: usize| {
            let tail = &jacobian[row * n + rank..(row + 1) * n];
            dot(tail, tail)
        };
        let longest = |b: usize, j| if rest(order[j]) > rest(order[b]) { j } else { b };
        let best = (rank..end).reduce(longest);
        let norm = best.map_or(T::ZERO, |best| rest(order[best]).sqrt());
        largest = largest.max(norm);
        let Some(best) = best.filter(|_| norm > tolerance * largest) else {
            if end == m {
                break;
            }
            end = m;
            continue;
        };
        order.swap(rank, best);
        let at = order[rank] * n;
        let mut v = jacobian[at + rank..at + n].to_vec();
        let alpha = if v[0] > T::ZERO { -norm } else { norm };
        v[0] -= alpha;
        let vv = dot(&v, &v);
        let reflect = |x: &mut [T]| {
            let factor = T::TWO * dot(&v, x) / vv;
            x.iter_mut().zip(&v).for_each(|(x, &v)| *x -= factor * v);
        };
        for &row in &order[rank..] {
            reflect(&mut jacobian[row * n + rank..(row + 1) * n]);
        }
        // Q <- Q H reflects every row of Q.
        for i in 0..n {
            let mut line: Vec<T> = (rank..n).map(|j| q[j * n + i]).collect();
            reflect(&mut line);
            (rank..n).zip(line).for_each(|(j, x)| q[j * n + i] = x);
        }
        rank += 1;
    }
    order.truncate(rank);
    let mut r = vec![T::ZERO; rank * rank];
    for (j, &row) in order.iter().enumerate() {
        r[j * rank..j * rank + j + 1].copy_from_slice(&jacobian[row * n..row * n + j + 1]);
    }
    let lengths = order.iter().map(|&row| lengths[row]).collect();
    (order, lengths, q, r)
}

/// Returns the cube root of a positive number by Newton's method, because the scalar trait has none.
fn cube_root(x: f64) -> f64 {
    let mut y = 1.0;
    for _ in 0..200 {
        y = (2.0 * y + x / (y * y)) / 3.0;
    }
    y
}

/// Computes L of a symmetric matrix in place; the lower triangle is given.
fn cholesky<T: Real>(a: &mut [T], f: usize) -> Result<(), usize> {
    let largest = (0..f).fold(T::ZERO, |most, j| most.max(a[j * f + j]));
    for j in 0..f {
        for k in 0..j {
            let factor = a[k * f + j];
            for i in j..f {
                let part = factor * a[k * f + i];
                a[j * f + i] -= part;
            }
        }
        let pivot = a[j * f + j];
        if !(pivot > largest * T::from_f64(NO_INERTIA).max(T::EPSILON)) {
            return Err(j);
        }
        let inverse = T::ONE / pivot.sqrt();
        a[j * f + j..(j + 1) * f].iter_mut().for_each(|x| *x *= inverse);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_repeated_row_leaves_the_split_as_it_is() {
        // The rows x + y = 0 (twice) and z = 0 in the coordinates x, y, z, w with mass diag(1, 3, 1, 4): the freedoms are x - y with mass
        // 4/2, and w.
        let jacobian = vec![1.0, 1.0, 0.0, 0.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let mass = |x: &[f64]| vec![x[0], 3.0 * x[1], x[2], 4.0 * x[3]];
        let tangent = TangentCoordinates::new(&[1.0; 4], (jacobian, |_| false), mass)
            .expect("every freedom has mass");
        assert_eq!(tangent.n_freedoms(), 2);
        for j in 0..2 {
            let b = tangent.direction(j);
            assert!((b[0] + b[1]).abs() < 1e-15 && b[2].abs() < 1e-15, "{b:?}");
            for k in 0..2 {
                let product = dot(tangent.direction(k), &mass(b));
                assert!((product - if j == k { 1.0 } else { 0.0 }).abs() < 1e-14);
            }
            let z = tangent.reduce(b);
            assert!((z[j] - 1.0).abs() < 1e-14 && z[1 - j].abs() < 1e-14, "{z:?}");
        }
        // Subtracts the smallest change that closes x + y = 0.2 and z = 0.5.
        let mut x = [0.0; 4];
        tangent.correct(&[0.2, 0.4, 0.5], &mut x);
        let wanted = [-0.1, -0.1, -0.5, 0.0];
        assert!(x.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-15), "{x:?}");
    }

    #[test]
    fn a_freedom_without_inertia_is_named() {
        let mass = |x: &[f64]| vec![x[0], 0.0];
        assert!(TangentCoordinates::new(&[1.0; 2], (vec![], |_| false), mass).is_err());
    }
}
