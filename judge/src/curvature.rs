//! Curvature of the change at the start, along the motions that rows allow. A stationary point is a minimum where no curvature is negative.

use crate::dense::Square;
use crate::motion::Mechanism;
use crate::rows::Row;

/// Largest number of sweeps of Jacobi's rotations, which converge quadratically.
const SWEEPS: usize = 30;

/// The least curvature along motions that rows allow, and that motion as a vector of length one, in scaled velocities.
pub(crate) struct Curvature {
    pub(crate) least: f64,
    pub(crate) along: Vec<f64>,
}

impl Mechanism {
    /// The least curvature of a scaled matrix along motions that rows allow; `None` where rows allow no motion.
    pub(crate) fn curvature(&self, matrix: &Square, rows: &[Row]) -> Option<Curvature> {
        let n = self.n_velocities();
        let basis = self.free_motions(rows);
        let product = |u: &[f64], v: &[f64]| -> f64 {
            let row = |i: usize| (0..n).map(|j| matrix.get(i, j) * v[j]).sum::<f64>();
            (0..n).map(|i| u[i] * row(i)).sum()
        };
        let mut a: Vec<Vec<f64>> =
            basis.iter().map(|u| basis.iter().map(|v| product(u, v)).collect()).collect();
        let k = basis.len();
        for i in 0..k {
            for j in 0..i {
                let mean = 0.5 * (a[i][j] + a[j][i]);
                (a[i][j], a[j][i]) = (mean, mean);
            }
        }
        let vectors = diagonalise(&mut a);
        let at = (0..k).min_by(|&i, &j| a[i][i].total_cmp(&a[j][j]))?;
        let mut along = vec![0.0; n];
        for (u, row) in basis.iter().zip(&vectors) {
            along.iter_mut().zip(u).for_each(|(x, u)| *x += row[at] * u);
        }
        Some(Curvature { least: a[at][at], along })
    }

    /// Orthonormal motions that rows allow, in scaled velocities.
    fn free_motions(&self, rows: &[Row]) -> Vec<Vec<f64>> {
        let n = self.n_velocities();
        let mut matrix = Square::zero(n.max(rows.len()));
        for (k, row) in rows.iter().enumerate() {
            let entries = self.dense_row(row);
            let length = entries.iter().map(|e| e.1 * e.1).sum::<f64>().sqrt();
            for (c, x) in entries {
                *matrix.at(k, c) += x / length.max(f64::MIN_POSITIVE);
            }
        }
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for mut v in matrix.factor().kernel() {
            // null vectors in the columns beyond the velocities are no motions
            if v[n..].iter().any(|x| *x != 0.0) {
                continue;
            }
            v.truncate(n);
            for u in basis.iter().chain(&basis.clone()) {
                let share: f64 = u.iter().zip(&v).map(|(a, b)| a * b).sum();
                v.iter_mut().zip(u).for_each(|(x, u)| *x -= share * u);
            }
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            v.iter_mut().for_each(|x| *x /= length);
            basis.push(v);
        }
        basis
    }
}

/// Makes a symmetric matrix diagonal by rotations. Returns the product of the rotations: its columns are the eigenvectors.
fn diagonalise(a: &mut [Vec<f64>]) -> Vec<Vec<f64>> {
    let k = a.len();
    let mut vectors: Vec<Vec<f64>> =
        (0..k).map(|i| (0..k).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    for _ in 0..SWEEPS {
        let off = |i: usize| a[i][..i].iter().fold(0.0_f64, |s, x| s.max(x.abs()));
        let size = (0..k).fold(0.0_f64, |s, i| s.max(a[i][i].abs()));
        if (0..k).all(|i| off(i) <= 1e-12 * size) {
            break;
        }
        for p in 0..k {
            for q in p + 1..k {
                let (s, c) = (0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p])).sin_cos();
                let turn = |x: &mut f64, y: &mut f64| (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                for row in a.iter_mut().chain(&mut vectors) {
                    let (left, right) = row.split_at_mut(q);
                    turn(&mut left[p], &mut right[0]);
                }
                let (above, below) = a.split_at_mut(q);
                above[p].iter_mut().zip(&mut below[0]).for_each(|(x, y)| turn(x, y));
            }
        }
    }
    vectors
}
