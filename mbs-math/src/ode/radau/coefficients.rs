//! Coefficients of the collocation at three Radau points, in any precision.

use super::complex::Complex;
use crate::Real;

/// Nodes, eigenvalues and eigenvectors of the matrix A of the method, see [`Coefficients::new`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Coefficients<T> {
    /// Nodes c of the stages.
    pub(super) nodes: [T; 3],
    /// Real eigenvalue γ of A⁻¹.
    pub(super) real: T,
    /// Complex eigenvalue α + i β of A⁻¹; the third eigenvalue is its conjugate.
    pub(super) complex: Complex<T>,
    /// Columns t₁, t₂, t₃ with A⁻¹ t₁ = γ t₁ and A⁻¹ (t₂ + i t₃) = (α − i β)(t₂ + i t₃).
    pub(super) basis: [[T; 3]; 3],
    /// Inverse of the basis.
    pub(super) inverse: [[T; 3]; 3],
    /// Weights d of the stages z in the error f + Σ dᵢ zᵢ / h.
    pub(super) error: [T; 3],
}

impl<T: Real> Coefficients<T> {
    /// Coefficients from √6 and the real root of γ³ − 9 γ² + 36 γ − 60, the denominator of the stability function.
    pub(super) fn new() -> Self {
        let number = |x: f64| T::from_f64(x);
        let root = number(6.0).sqrt();
        let ratio = |whole: f64, roots: f64, under: f64| {
            (number(whole) + number(roots) * root) / number(under)
        };
        let nodes = [ratio(4.0, -1.0, 10.0), ratio(4.0, 1.0, 10.0), T::ONE];
        // Matrix A without its last row.
        let a = [
            [ratio(88.0, -7.0, 360.0), ratio(296.0, -169.0, 1800.0), ratio(-2.0, 3.0, 225.0)],
            [ratio(296.0, 169.0, 1800.0), ratio(88.0, 7.0, 360.0), ratio(-2.0, -3.0, 225.0)],
        ];

        let mut real = number(3.637_834_252_744_496);
        // Newton's method improves the root from 16 digits to the precision of any scalar.
        for _ in 0..3 {
            let value = ((real - number(9.0)) * real + number(36.0)) * real - number(60.0);
            let slope = (number(3.0) * real - number(18.0)) * real + number(36.0);
            real -= value / slope;
        }
        // The two complex eigenvalues solve x² + (γ − 9) x + 60/γ.
        let alpha = (number(9.0) - real) * T::HALF;
        let beta = (number(60.0) / real - alpha * alpha).sqrt();

        let first = eigenvector(&a, Complex::new(real, T::ZERO));
        let second = eigenvector(&a, Complex::new(alpha, -beta));
        let basis = core::array::from_fn(|i| [first[i].re, second[i].re, second[i].im]);
        Self {
            nodes,
            real,
            complex: Complex::new(alpha, beta),
            basis,
            inverse: inverse(&basis),
            error: [ratio(-13.0, -7.0, 3.0), ratio(-13.0, 7.0, 3.0), ratio(-1.0, 0.0, 3.0)],
        }
    }

    /// Weights of the stages z in the value of the collocation polynomial at `place` (in steps). The polynomial is zero at place zero.
    pub(super) fn at(&self, place: T) -> [T; 3] {
        core::array::from_fn(|j| {
            let own = self.nodes[j];
            let others = self.nodes.iter().enumerate().filter(|&(k, _)| k != j);
            others.fold(place / own, |weight, (_, &c)| weight * (place - c) / (own - c))
        })
    }
}

/// Eigenvector v with A v = v / `value` whose last component is one.
fn eigenvector<T: Real>(a: &[[T; 3]; 2], value: Complex<T>) -> [Complex<T>; 3] {
    let of = |x: T| Complex::new(x, T::ZERO);
    let shift = of(T::ONE) / value;
    let (d0, d1) = (of(a[0][0]) - shift, of(a[1][1]) - shift);
    let (u0, u1) = (of(a[0][1]), of(a[1][0]));
    let (b0, b1) = (of(-a[0][2]), of(-a[1][2]));
    let determinant = d0 * d1 - u0 * u1;
    [(b0 * d1 - u0 * b1) / determinant, (d0 * b1 - u1 * b0) / determinant, of(T::ONE)]
}

fn inverse<T: Real>(m: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    let minor = |i: usize, j: usize| {
        let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1]
    };
    let determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    core::array::from_fn(|i| core::array::from_fn(|j| minor(j, i) / determinant))
}
