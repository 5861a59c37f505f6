//! Elimination with complex numbers: [real, imaginary].

use crate::tree::Matrix;

/// A complex number.
pub(super) type Complex = [f64; 2];

pub(super) fn product([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

pub(super) fn quotient(a: Complex, [c, d]: Complex) -> Complex {
    // scaled by the divisor's larger part, as squares overflow earlier
    let scale = c.abs().max(d.abs());
    let [c, d] = [c / scale, d / scale];
    let by = (c * c + d * d) * scale;
    let [x, y] = product(a, [c, -d]);
    [x / by, y / by]
}

pub(super) fn size([a, b]: Complex) -> f64 {
    libm::hypot(a, b)
}

fn subtract(from: &mut Complex, [a, b]: Complex) {
    from[0] -= a;
    from[1] -= b;
}

/// L and U of a square matrix with its rows exchanged.
pub(super) struct Factor {
    n: usize,
    /// Row by row.
    lu: Vec<Complex>,
    rows: Vec<usize>,
    /// The smallest pivot, relative to the largest entry of the matrix.
    pub(super) least: f64,
}

impl Factor {
    /// Eliminates a matrix, row by row. A pivot that is zero becomes rounding of the largest entry.
    pub(super) fn new(n: usize, lu: Vec<Complex>) -> Self {
        let largest = lu.iter().fold(f64::MIN_POSITIVE, |most, x| most.max(size(*x)));
        let mut new = Self { n, lu, rows: (0..n).collect(), least: 1.0 };
        for k in 0..n {
            let pivot =
                (k..n).fold(k, |best, i| if new.at(i, k) > new.at(best, k) { i } else { best });
            new.rows.swap(k, pivot);
            for j in 0..n {
                new.lu.swap(k * n + j, pivot * n + j);
            }
            new.least = new.least.min(new.at(k, k) / largest);
            if !(new.at(k, k) > f64::EPSILON * largest) {
                new.lu[k * n + k] = [f64::EPSILON * largest, 0.0];
            }
            for i in k + 1..n {
                let factor = quotient(new.lu[i * n + k], new.lu[k * n + k]);
                new.lu[i * n + k] = factor;
                for j in k + 1..n {
                    let part = product(factor, new.lu[k * n + j]);
                    subtract(&mut new.lu[i * n + j], part);
                }
            }
        }
        new
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        size(self.lu[i * self.n + j])
    }

    /// x of A x = b.
    pub(super) fn solve(&self, b: &[Complex]) -> Vec<Complex> {
        let n = self.n;
        let mut x: Vec<Complex> = self.rows.iter().map(|&row| b[row]).collect();
        for i in 0..n {
            for j in 0..i {
                let part = product(self.lu[i * n + j], x[j]);
                subtract(&mut x[i], part);
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                let part = product(self.lu[i * n + j], x[j]);
                subtract(&mut x[i], part);
            }
            x[i] = quotient(x[i], self.lu[i * n + i]);
        }
        x
    }
}

/// Smallest ratio of a pivot and the largest entry for which a matrix is regular [-]: its inverse leaves four digits.
const REGULAR: f64 = 1e-12;

/// R S^-1 of each R; nothing where S is singular. Columns of S are taken in their own sizes.
pub(super) fn divided(of: [&Matrix; 2], s: &Matrix) -> Option<[Matrix; 2]> {
    let n = s.rows;
    let column = |j: usize| (0..n).fold(0.0_f64, |most, i| most.max(s[(i, j)].abs()));
    let sizes: Vec<f64> = (0..n).map(column).collect();
    if sizes.contains(&0.0) {
        return None;
    }
    // S^T x = r for each row r
    let entries = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let transposed = entries.map(|(i, j)| [s[(i, j)] / sizes[j], 0.0]).collect();
    let factor = Factor::new(n, transposed);
    if n > 0 && !(factor.least > REGULAR) {
        return None;
    }
    Some(of.map(|r| {
        let mut to = Matrix::zeros(r.rows, n);
        for i in 0..r.rows {
            let row: Vec<Complex> = (0..n).map(|j| [r[(i, j)] / sizes[j], 0.0]).collect();
            for (j, [x, _]) in factor.solve(&row).into_iter().enumerate() {
                to[(i, j)] = x;
            }
        }
        to
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a product of three rows.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn a_complex_system_is_solved() {
        let a = [
            [0.0, 0.0],
            [1.0, 2.0],
            [0.5, -1.0],
            [3.0, 0.0],
            [0.0, 1.0],
            [2.0, 0.0],
            [1.0, 1.0],
            [0.0, 0.0],
            [0.0, -2.0],
        ];
        let x = [[1.0, -1.0], [2.0, 0.5], [0.0, 3.0]];
        let row = |i: usize| {
            (0..3).fold([0.0; 2], |sum: Complex, j| {
                let [re, im] = product(a[3 * i + j], x[j]);
                [sum[0] + re, sum[1] + im]
            })
        };
        let found = Factor::new(3, a.to_vec()).solve(&[row(0), row(1), row(2)]);
        for (found, x) in found.iter().zip(x) {
            assert!(size([found[0] - x[0], found[1] - x[1]]) < ROUNDING, "{found:?}");
        }
    }

    #[test]
    fn what_a_singular_matrix_divides_is_refused() {
        let matrix = |data: [f64; 4]| Matrix { rows: 2, columns: 2, data: data.to_vec() };
        let (r, s) = (matrix([1.0, 2.0, 3.0, 4.0]), matrix([1.0, 2.0, 2.0, 4.0]));
        assert_eq!(divided([&r, &r], &s), None);
        let Some([x, _]) = divided([&r, &r], &matrix([0.0, 2.0, 1e-9, 0.0])) else {
            panic!("columns count in their sizes");
        };
        for (found, right) in x.data.iter().zip([1.0, 1e9, 2.0, 3e9]) {
            assert!((found - right).abs() < ROUNDING * right, "{:?}", x.data);
        }
    }
}
