//! Singular values and vectors, by Golub and Reinsch (1970).
//!
//! ```text
//! A = U₁ B V₁ᵀ            B = bidiag(d, e), by reflections I − β x xᵀ from both sides in turn
//! B ← Sᵀ B T              S, T: rotations that chase a bulge down;  the first of T aims at BᵀB − μ
//! A = U Σ Vᵀ,   σ₁ ≥ σ₂ ≥ … ≥ 0,   U = U₁ S …,   V = V₁ T …
//! ```
//!
//! U and V are products of reflections and rotations, so they are orthogonal to machine precision for every rank. An entry of B below ε ‖B‖
//! counts as zero. So all singular values have an error of a small multiple of ε σ₁.

use crate::matrix::{Matrix, add, dot};
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;

/// Singular values with their vectors.
#[derive(Debug, Clone)]
pub struct Svd {
    /// Left singular vectors as columns.
    pub u: Matrix,
    /// Singular values in descending order, as many as the smaller dimension of the matrix.
    pub sigma: Vec<f64>,
    /// Right singular vectors as columns.
    pub v: Matrix,
}

/// Largest number of sweeps for each singular value. Two sweeps are usual.
const MAX_SWEEPS: usize = 60;

/// Sum of squares that counts as zero in a matrix with entries of order one [-]. Numbers below 1e-308 lose digits, and this limit is far
/// above.
const TINY: f64 = 1e-280;

/// Singular vectors that a caller requires.
#[derive(Clone, Copy)]
enum Vectors {
    None,
    Thin,
    All,
}

impl Svd {
    /// Decomposes a matrix with all vectors: U and V are square. Returns `None` if an entry is not finite, or the iteration does not
    /// converge.
    ///
    /// Cost: about 4 m² n + 20 m n² operations for m ≥ n.
    #[must_use]
    pub fn new(matrix: &Matrix) -> Option<Self> {
        of(matrix, Vectors::All)
    }

    /// Decomposes a matrix with one vector on each side for each singular value. Returns `None` where [`Svd::new`] does.
    ///
    /// Cost: about 20 m n² operations for m ≥ n.
    #[must_use]
    pub fn thin(matrix: &Matrix) -> Option<Self> {
        of(matrix, Vectors::Thin)
    }
}

/// Returns the singular values alone, in descending order. Returns `None` where [`Svd::new`] does.
///
/// Cost: about 4 m n² operations for m ≥ n.
#[must_use]
pub fn singular_values(matrix: &Matrix) -> Option<Vec<f64>> {
    of(matrix, Vectors::None).map(|svd| svd.sigma)
}

fn of(matrix: &Matrix, vectors: Vectors) -> Option<Svd> {
    if matrix.n_rows() < matrix.n_columns() {
        return tall(matrix.transpose(), vectors).map(|Svd { u, sigma, v }| Svd {
            u: v,
            sigma,
            v: u,
        });
    }
    tall(matrix.clone(), vectors)
}

/// Decomposes a matrix that has no more columns than rows.
fn tall(mut a: Matrix, vectors: Vectors) -> Option<Svd> {
    let (m, n) = (a.n_rows(), a.n_columns());
    let largest = a.largest()?;
    // The matrix is scaled to entries of order one. The scale is a power of two, so that no entry is rounded.
    let scale = if largest > 0.0 { power_of_two(largest) } else { 1.0 };
    a.scale(1.0 / scale);
    let reduced = Bidiagonal::of(&mut a);
    let (u, v) = match vectors {
        Vectors::None => (Matrix::zeros(0, n), Matrix::zeros(0, n)),
        Vectors::Thin => (reduced.left(&a, n), reduced.right()),
        Vectors::All => (reduced.left(&a, m), reduced.right()),
    };
    let mut chase = Chase { d: reduced.d, e: reduced.e, u, v };
    chase.run()?;
    Some(chase.sorted(scale))
}

/// Returns the largest power of two up to `x`, or the smallest whose reciprocal is finite.
fn power_of_two(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & (0x7FF << 52)).max(f64::MIN_POSITIVE)
}

/// Diagonals d and e of B, and the reflections. The vectors of the left reflections are stored in A, on and below its diagonal.
struct Bidiagonal {
    d: Vec<f64>,
    e: Vec<f64>,
    beta: Vec<f64>,
    rows: Vec<(f64, Vec<f64>)>,
}

impl Bidiagonal {
    /// Computes the bidiagonal matrix B of A. The vectors of the reflections from the left replace the columns of A.
    fn of(a: &mut Matrix) -> Self {
        let (m, n) = (a.n_rows(), a.n_columns());
        let mut all = Self { d: Vec::new(), e: Vec::new(), beta: Vec::new(), rows: Vec::new() };
        let mut image = vec![0.0; m];
        for k in 0..n {
            // d_k = (I − β x xᵀ) a_k
            let (beta, d) = reflection(&mut a.column_mut(k)[k..]);
            for j in k + 1..n {
                let (x, y) = a.two_columns(k, j);
                reflect(beta, &x[k..], &mut y[k..]);
            }
            all.beta.push(beta);
            all.d.push(d);
            if k + 1 == n {
                break;
            }

            // e_k = row k (I − β x xᵀ),   A ← A − β (A x) xᵀ
            let mut x: Vec<f64> = (k + 1..n).map(|j| a[(k, j)]).collect();
            let (beta, e) = reflection(&mut x);
            image[k + 1..].fill(0.0);
            for (j, &x) in (k + 1..n).zip(&x) {
                add(&mut image[k + 1..], x, &a.column(j)[k + 1..]);
            }
            for (j, &x) in (k + 1..n).zip(&x) {
                add(&mut a.column_mut(j)[k + 1..], -beta * x, &image[k + 1..]);
            }
            all.rows.push((beta, x));
            all.e.push(e);
        }
        all
    }

    /// Returns the first columns of U₁, the product of the reflections from the left.
    fn left(&self, a: &Matrix, n_columns: usize) -> Matrix {
        let mut u = Matrix::identity(a.n_rows(), n_columns);
        for (k, &beta) in self.beta.iter().enumerate().rev() {
            for j in k..n_columns {
                reflect(beta, &a.column(k)[k..], &mut u.column_mut(j)[k..]);
            }
        }
        u
    }

    /// Returns V₁, the product of the reflections from the right.
    fn right(&self) -> Matrix {
        let n = self.d.len();
        let mut v = Matrix::identity(n, n);
        for (k, (beta, x)) in self.rows.iter().enumerate().rev() {
            for j in k + 1..n {
                reflect(*beta, x, &mut v.column_mut(j)[k + 1..]);
            }
        }
        v
    }
}

/// Overwrites x by the vector of the reflection that maps x to the first axis. Returns β and the first entry of the image.
fn reflection(x: &mut [f64]) -> (f64, f64) {
    let Some((&first, rest)) = x.split_first() else { return (0.0, 0.0) };
    let rest = dot(rest, rest);
    if rest < TINY {
        return (0.0, first);
    }
    let left = -Real::sqrt(first * first + rest).copysign(first);
    // x₀ − left has no cancellation;   β = 2 / xᵀx
    x[0] = first - left;
    (2.0 / (x[0] * x[0] + rest), left)
}

/// Reflects a vector: y ← y − β x (xᵀ y).
fn reflect(beta: f64, x: &[f64], y: &mut [f64]) {
    if beta != 0.0 {
        let share = beta * dot(x, y);
        add(y, -share, x);
    }
}

/// Returns the rotation c, s and the length r with c f + s g = r and c g − s f = 0.
fn rotation(f: f64, g: f64) -> (f64, f64, f64) {
    let r = libm::hypot(f, g);
    if r == 0.0 { (1.0, 0.0, 0.0) } else { (f / r, g / r, r) }
}

/// Rotates columns i and j into c xᵢ + s xⱼ and c xⱼ − s xᵢ.
fn rotate(x: &mut Matrix, (i, j): (usize, usize), (c, s): (f64, f64)) {
    let (x, y) = x.two_columns(i, j);
    for (x, y) in x.iter_mut().zip(y) {
        (*x, *y) = (c * *x + s * *y, c * *y - s * *x);
    }
}

/// Bidiagonal matrix B during the iteration; e_k is to the right of d_k.
struct Chase {
    d: Vec<f64>,
    e: Vec<f64>,
    u: Matrix,
    v: Matrix,
}

impl Chase {
    fn run(&mut self) -> Option<()> {
        let size = self.d.iter().chain(&self.e).fold(0.0_f64, |l, x| l.max(x.abs()));
        let zero = f64::EPSILON * size;
        for high in (1..self.d.len()).rev() {
            let mut sweeps = 0;
            loop {
                let low = self.block(high, zero);
                if low == high {
                    break;
                }
                if sweeps == MAX_SWEEPS {
                    return None;
                }
                sweeps += 1;
                self.sweep(low, high);
            }
        }
        Some(())
    }

    /// Returns the first row of the last block. In a block no e is zero, and no d except possibly the last.
    fn block(&mut self, high: usize, zero: f64) -> usize {
        for low in (1..=high).rev() {
            if self.e[low - 1].abs() <= zero {
                self.e[low - 1] = 0.0;
                return low;
            }
            if self.d[low - 1].abs() <= zero {
                self.clear_row(low - 1, high);
                return low;
            }
        }
        0
    }

    /// Makes e_k zero, for d_k = 0, by rotations of row k with the rows below.
    fn clear_row(&mut self, k: usize, high: usize) {
        self.d[k] = 0.0;
        let mut left = core::mem::take(&mut self.e[k]);
        for i in k + 1..=high {
            let (c, s, r) = rotation(self.d[i], left);
            self.d[i] = r;
            if i < high {
                left = -s * self.e[i];
                self.e[i] *= c;
            }
            rotate(&mut self.u, (k, i), (c, -s));
        }
    }

    /// Makes one step of the QR iteration on rows low to high.
    fn sweep(&mut self, low: usize, high: usize) {
        // (d² − μ) / d and e: the first column of BᵀB − μ, divided by d
        let (mut f, mut g) = (self.d[low] - self.shift(low, high) / self.d[low], self.e[low]);
        for k in low..high {
            let (c, s, r) = rotation(f, g);
            if k > low {
                self.e[k - 1] = r;
            }
            (self.d[k], self.e[k]) = (c * self.d[k] + s * self.e[k], c * self.e[k] - s * self.d[k]);
            let bulge = s * self.d[k + 1];
            self.d[k + 1] *= c;
            rotate(&mut self.v, (k, k + 1), (c, s));

            let (c, s, r) = rotation(self.d[k], bulge);
            self.d[k] = r;
            (self.e[k], self.d[k + 1]) =
                (c * self.e[k] + s * self.d[k + 1], c * self.d[k + 1] - s * self.e[k]);
            rotate(&mut self.u, (k, k + 1), (c, s));
            if k + 1 < high {
                f = self.e[k];
                g = s * self.e[k + 1];
                self.e[k + 1] *= c;
            }
        }
    }

    /// Returns the shift μ of the iteration: the eigenvalue of the last two rows of BᵀB that is closer to their last entry.
    fn shift(&self, low: usize, high: usize) -> f64 {
        let before = if high - 1 > low { self.e[high - 2] } else { 0.0 };
        let (d, e) = (self.d[high - 1], self.e[high - 1]);
        let (first, last) = (d * d + before * before, self.d[high] * self.d[high] + e * e);
        let half = (first - last) / 2.0;
        let beside = d * e;
        // Neither d nor e is zero, so `beside` is not zero. So the denominator is not zero, even if `half` is.
        last - beside / (half + libm::hypot(half, beside).copysign(half)) * beside
    }

    /// Returns the singular values as positive numbers in descending order, with their vectors.
    fn sorted(mut self, scale: f64) -> Svd {
        let n = self.d.len();
        for k in 0..n {
            if self.d[k].is_sign_negative() {
                self.d[k] = -self.d[k];
                self.v.column_mut(k).iter_mut().for_each(|x| *x = -*x);
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| self.d[j].total_cmp(&self.d[i]));
        let sorted = |x: &Matrix| {
            let place = |j: usize| if j < n { order[j] } else { j };
            Matrix::from_fn(x.n_rows(), x.n_columns(), |i, j| x[(i, place(j))])
        };
        let sigma = order.iter().map(|&k| self.d[k] * scale).collect();
        Svd { u: sorted(&self.u), sigma, v: sorted(&self.v) }
    }
}

#[cfg(test)]
mod tests;
