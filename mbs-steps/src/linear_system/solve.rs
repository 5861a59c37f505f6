//! Gaussian elimination with complex numbers, stored as [real, imaginary].

use crate::tree::Matrix;

/// Complex number, by its real and imaginary part.
pub type Complex = [f64; 2];

/// The product of two complex numbers.
pub fn product([a, b]: Complex, [c, d]: Complex) -> Complex {
    [a * c - b * d, a * d + b * c]
}

pub(super) fn quotient(a: Complex, [c, d]: Complex) -> Complex {
    // The division is scaled by the larger part of the divisor, because squares could overflow.
    let scale = c.abs().max(d.abs());
    let [c, d] = [c / scale, d / scale];
    let by = (c * c + d * d) * scale;
    let [x, y] = product(a, [c, -d]);
    [x / by, y / by]
}

/// Absolute value of a complex number.
pub fn size([a, b]: Complex) -> f64 {
    libm::hypot(a, b)
}

fn subtract(from: &mut Complex, [a, b]: Complex) {
    from[0] -= a;
    from[1] -= b;
}

/// LU factorisation of a square matrix with row pivoting.
#[derive(Debug)]
pub struct Factor {
    n: usize,
    /// Factors L and U in one matrix, row by row.
    lu: Vec<Complex>,
    rows: Vec<usize>,
    /// Smallest pivot, relative to the largest entry of the matrix.
    pub(super) least: f64,
}

impl Factor {
    /// Factorises a matrix that is given row by row. A zero pivot is replaced by machine precision times the largest entry of the matrix.
    pub fn new(n: usize, lu: Vec<Complex>) -> Self {
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

    /// Solves A x = b.
    pub fn solve(&self, b: &[Complex]) -> Vec<Complex> {
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

/// Smallest ratio of a pivot to the largest entry for which a matrix counts as regular [-]. The inverse then has four correct digits.
const REGULAR: f64 = 1e-12;

/// Computes R S^-1 for two matrices R; `None` if S is singular. The columns of S are scaled by their largest entries.
pub fn divided(of: [&Matrix; 2], s: &Matrix) -> Option<[Matrix; 2]> {
    let n = s.rows;
    let column = |j: usize| (0..n).fold(0.0_f64, |most, i| most.max(s[(i, j)].abs()));
    let sizes: Vec<f64> = (0..n).map(column).collect();
    if sizes.contains(&0.0) {
        return None;
    }
    // Each row r of R is the right-hand side of S^T x = r.
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
