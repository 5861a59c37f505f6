//! Small vectors, and the coefficient by which a natural coordinate vector enters a body's points.
//!
//! A point of a rigid body is a fixed linear combination of its basis entities (points and directions):
//!
//! ```text
//! space:  r = sum_k a_k e_k               a_k real
//! plane:  r = sum_k (a_k + b_k J) e_k     J = quarter turn, that is complex coefficients
//! ```
//!
//! The second part b of a coefficient is zero in space, so [`Coef`] serves the plane and space.

use crate::Real;
use nalgebra::{SMatrix, SVector};

/// A column of D numbers.
pub type Vector<T, const D: usize> = SVector<T, D>;
/// A D x D matrix.
pub type Matrix<T, const D: usize> = SMatrix<T, D, D>;

/// A column vector of the given numbers. The function is `const`, so that constants can be built with it.
#[must_use]
pub const fn vector<T, const D: usize>(numbers: [T; D]) -> Vector<T, D> {
    Vector::from_array_storage(nalgebra::ArrayStorage([numbers]))
}

/// A coefficient alpha + beta J of the plane; in space it is alpha alone, and beta is zero.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coef<T> {
    /// Coefficient alpha of the identity.
    pub re: T,
    /// Coefficient beta of J.
    pub im: T,
}

impl<T: Real> Coef<T> {
    /// Coefficient that is zero.
    #[must_use]
    pub fn zero() -> Self {
        Self { re: T::ZERO, im: T::ZERO }
    }
    /// Coefficient that is one.
    #[must_use]
    pub fn one() -> Self {
        Self { re: T::ONE, im: T::ZERO }
    }
    /// Coefficient with alpha alone.
    pub fn real(re: T) -> Self {
        Self { re, im: T::ZERO }
    }
    /// Sum of two coefficients.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
    /// Difference of two coefficients.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        self.plus(other.scaled(-T::ONE))
    }
    /// This coefficient multiplied by a real number.
    #[must_use]
    pub fn scaled(self, s: T) -> Self {
        Self { re: self.re * s, im: self.im * s }
    }
    /// Product of two coefficients, multiplied as complex numbers.
    #[must_use]
    pub fn times(self, o: Self) -> Self {
        Self { re: self.re * o.re - self.im * o.im, im: self.re * o.im + self.im * o.re }
    }
    /// Complex conjugate, the transpose of alpha + beta J.
    #[must_use]
    pub fn conj(self) -> Self {
        Self { re: self.re, im: -self.im }
    }
    /// Squared modulus alpha^2 + beta^2.
    #[must_use]
    pub fn norm_squared(self) -> T {
        self.re * self.re + self.im * self.im
    }
    /// True if alpha and beta are exactly zero.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.re == T::ZERO && self.im == T::ZERO
    }

    /// The product (alpha + beta J) x, with alpha alone in space.
    #[inline(always)]
    #[must_use]
    pub fn apply<const D: usize>(self, x: &Vector<T, D>) -> Vector<T, D> {
        let mut r = x * self.re;
        if D == 2 {
            r[0] -= self.im * x[1];
            r[1] += self.im * x[0];
        }
        r
    }

    /// The product (alpha + beta J)^T x, with alpha alone in space.
    #[inline(always)]
    #[must_use]
    pub fn apply_transposed<const D: usize>(self, x: &Vector<T, D>) -> Vector<T, D> {
        self.conj().apply(x)
    }
}

/// Reads the D numbers of `x` that begin at index `at`.
#[inline(always)]
pub fn load<T: Real, const D: usize>(x: &[T], at: u32) -> Vector<T, D> {
    let at = at as usize;
    let x = &x[at..at + D];
    Vector::from_fn(|i, _| x[i])
}

/// Writes the D numbers of `y` into `x`, beginning at index `at`.
#[inline(always)]
pub fn store<T: Real, const D: usize>(x: &mut [T], at: u32, y: &Vector<T, D>) {
    let at = at as usize;
    let x = &mut x[at..at + D];
    for i in 0..D {
        x[i] = y[i];
    }
}

/// Adds the D numbers of `y` to `x`, beginning at index `at`.
#[inline(always)]
pub fn add_to<T: Real, const D: usize>(x: &mut [T], at: usize, y: &Vector<T, D>) {
    let x = &mut x[at..at + D];
    for i in 0..D {
        x[i] += y[i];
    }
}

/// The unit vector along axis `i`.
pub fn unit<T: Real>(i: usize) -> Vector<T, 3> {
    let mut e = Vector::<T, 3>::zeros();
    e[i] = T::ONE;
    e
}

/// A vector of the plane or of space, as a vector of space: components that the plane lacks are zero.
#[inline(always)]
pub fn raised<T: Real, const D: usize>(x: &Vector<T, D>) -> Vector<T, 3> {
    Vector::from_fn(|i, _| if i < D { x[i] } else { T::ZERO })
}

/// The first D components of a vector of space: x and y for the plane, all for space.
#[inline(always)]
pub fn lowered<T: Real, const D: usize>(x: &Vector<T, 3>) -> Vector<T, D> {
    Vector::from_fn(|i, _| x[i])
}

/// Euclidean length of a vector.
pub fn norm<T: Real, const D: usize>(x: &Vector<T, D>) -> T {
    x.dot(x).sqrt()
}

/// The unit vector along a vector that is not zero. A vector of extreme length is first divided by its largest component, since its square
/// would leave the range of the scalar.
#[cfg(feature = "alloc")]
pub fn along<T: Real>(x: &Vector<T, 3>) -> Vector<T, 3> {
    /// Bounds of the lengths whose squares stay within the range of `f32`, 1e-38 to 3e38 [-].
    const USUAL: [f64; 2] = [1e-15, 1e15];
    let size = norm_inf(x.as_slice());
    let [least, most] = USUAL.map(T::from_f64);
    let is_usual = size > least && size < most;
    // A product with 1/size would not do: 1/size overflows for the smallest sizes.
    let x = if is_usual { *x } else { x.map(|x| x / size) };
    x * (T::ONE / norm(&x))
}

/// Largest absolute value in a slice; NaN when a number in it is NaN. Comparisons alone are used: no branches, and no arithmetic that would
/// enter the counts of operations.
#[inline]
pub fn norm_inf<T: Real>(x: &[T]) -> T {
    let (mut largest, mut are_numbers) = (T::ZERO, true);
    for &xi in x {
        let size = xi.abs();
        largest = largest.max(size);
        are_numbers &= size >= T::ZERO;
    }
    if are_numbers { largest } else { T::from_f64(f64::NAN) }
}

/// Cross product a x b.
pub fn cross<T: Real>(a: &Vector<T, 3>, b: &Vector<T, 3>) -> Vector<T, 3> {
    Vector::<T, 3>::new(
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
}

/// A unit vector perpendicular to the unit vector `n`. The choice is deterministic: equal `n` give equal results.
pub fn across<T: Real>(n: &Vector<T, 3>) -> Vector<T, 3> {
    let mut least = 0;
    for i in 1..3 {
        if n[i].abs() < n[least].abs() {
            least = i;
        }
    }
    let w = unit::<T>(least) - n * n[least];
    w * (T::ONE / norm(&w))
}

/// Rotation matrix of a rotation vector (axis times angle) [rad].
pub fn rotation<T: Real>(w: &Vector<T, 3>) -> Matrix<T, 3> {
    let angle = norm(w);
    if angle == T::ZERO {
        return Matrix::<T, 3>::identity();
    }
    let n = w * (T::ONE / angle);
    let (s, c) = angle.sin_cos();
    let mut r = Matrix::<T, 3>::zeros();
    for j in 0..3 {
        let e = unit(j);
        let column = e * c + cross(&n, &e) * s + n * (n[j] * (T::ONE - c));
        for i in 0..3 {
            r[(i, j)] = column[i];
        }
    }
    r
}

/// Rotation vector of a rotation matrix, angle in [0, pi] [rad].
pub fn rotation_vector<T: Real>(r: &Matrix<T, 3>) -> Vector<T, 3> {
    let w =
        Vector::<T, 3>::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)])
            * T::HALF;
    let (sine, cosine) = (norm(&w), (r[(0, 0)] + r[(1, 1)] + r[(2, 2)] - T::ONE) * T::HALF);
    let angle = sine.atan2(cosine);
    if cosine > -T::HALF {
        return if sine == T::ZERO { w } else { w * (angle / sine) };
    }
    // Near half a turn the axis comes from the symmetric part, R + R^T = 2 c 1 + 2 (1 - c) n n^T, since w is nearly zero there.
    let mut k = 0;
    for i in 1..3 {
        if r[(i, i)] > r[(k, k)] {
            k = i;
        }
    }
    let mut n = Vector::<T, 3>::zeros();
    for i in 0..3 {
        n[i] = (r[(i, k)] + r[(k, i)]) * T::HALF;
    }
    n[k] -= cosine;
    n *= T::ONE / norm(&n);
    if n.dot(&w) < T::ZERO { n * -angle } else { n * angle }
}

/// Gradient g of component i of the rotation vector w = log(R). R converts components in a rotated frame to components in the first frame.
/// When the rotated frame turns with the angular velocity omega [rad/s], the rate of the component is w_i' = g.omega. Both g and omega have
/// their components in the first frame.
///
/// ```text
/// g = e_i + w x e_i / 2 + c w x (w x e_i),   c = (1 - a cot a) / |w|^2,   a = |w| / 2
/// ```
///
/// The gradient grows without limit as |w| approaches a whole turn, 2 pi, where the rotation vector is not defined.
pub fn rotation_gradient<T: Real>(w: &Vector<T, 3>, i: usize) -> Vector<T, 3> {
    let square = w.dot(w);
    let c = if square < T::EPSILON.sqrt().sqrt() {
        // Series 1/12 + |w|^2/720 + |w|^4/30240: the next term is below machine precision.
        T::ONE / T::from_f64(12.0)
            + square * (T::ONE / T::from_f64(720.0) + square / T::from_f64(30240.0))
    } else {
        let half = square.sqrt() * T::HALF;
        let (s, c) = half.sin_cos();
        (T::ONE - half * c / s) / square
    };
    let e = unit::<T>(i);
    let across = cross(w, &e);
    e + across * T::HALF + cross(w, &across) * c
}

/// Inverse of a small matrix by Gauss-Jordan elimination with row pivoting; `None` when singular.
pub fn inverse<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> Option<SMatrix<T, N, N>> {
    let (mut a, mut b) = (*a, SMatrix::<T, N, N>::identity());
    for k in 0..N {
        let mut p = k;
        for i in k + 1..N {
            if a[(i, k)].abs() > a[(p, k)].abs() {
                p = i;
            }
        }
        if a[(p, k)] == T::ZERO || !a[(p, k)].is_finite() {
            return None;
        }
        a.swap_rows(p, k);
        b.swap_rows(p, k);
        let d = T::ONE / a[(k, k)];
        for j in 0..N {
            a[(k, j)] *= d;
            b[(k, j)] *= d;
        }
        for i in 0..N {
            let f = a[(i, k)];
            if i != k && f != T::ZERO {
                for j in 0..N {
                    let (aj, bj) = (a[(k, j)], b[(k, j)]);
                    a[(i, j)] -= f * aj;
                    b[(i, j)] -= f * bj;
                }
            }
        }
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bound of the rounding errors of a few products of numbers of order one [-].
    const ROUNDING: f64 = 1e-14;

    #[cfg(feature = "alloc")]
    #[test]
    fn the_direction_of_a_vector_does_not_ask_for_its_length() {
        let near = |x: Vector<f32, 3>| {
            let along = along(&x);
            assert!((along - Vector::<f32, 3>::new(0.6, 0.0, -0.8)).norm() < 2e-7, "{x}: {along}");
        };
        for size in [1e-32_f32, 1e-25, 1e-14, 1.0, 1e14, 1e20, 4e37] {
            near(Vector::<f32, 3>::new(3.0 * size, 0.0, -4.0 * size));
        }
    }

    #[test]
    fn rotation_vector_inverts_rotation_up_to_half_a_turn() {
        for w in [
            [0.3, -0.2, 0.9],
            [0.0, 0.0, 3.13],
            [1e-9, 0.0, 0.0],
            [-2.0, 2.0, 1.0],
            [0.0, -3.1405, 0.0],
        ] {
            let w = Vector::<f64, 3>::from_row_slice(&w);
            let back = rotation_vector(&rotation(&w));
            assert!(norm(&(back - w)) < 1e-10, "{w} {back}");
        }
    }

    #[test]
    fn the_gradient_of_a_rotation_vector_is_its_difference_quotient() {
        for w in [[0.0, 0.0, 0.0], [1e-5, 0.0, 2e-5], [0.3, -0.2, 0.9], [-1.7, 1.5, 1.2]] {
            let w = Vector::<f64, 3>::from_row_slice(&w);
            for k in 0..3 {
                // Error of a central difference: a term with the square of the step, and the rounding error divided by the step.
                let h = 1e-5;
                let at = |x: f64| rotation_vector(&(rotation(&(unit(k) * x)) * rotation(&w)));
                let difference = (at(h) - at(-h)) * (0.5 / h);
                for i in 0..3 {
                    let g = rotation_gradient(&w, i);
                    assert!((g[k] - difference[i]).abs() < 1e-9, "{w} {i} {k}");
                }
            }
        }
    }

    #[test]
    fn inverse_times_matrix_is_identity() {
        let a = SMatrix::<f64, 4, 4>::from_fn(|i, j| 1.0 / (1.0 + (i * 3 + j * 7 % 5) as f64));
        let a = a + SMatrix::<f64, 4, 4>::identity();
        let p = inverse(&a).unwrap() * a - SMatrix::<f64, 4, 4>::identity();
        assert!(norm_inf(p.as_slice()) < ROUNDING);
    }

    #[test]
    fn coefficient_turns_a_planar_vector_like_a_complex_number() {
        let c = Coef { re: 0.6, im: 0.8 };
        let x = c.apply(&Vector::<f64, 2>::new(1.0, 0.0));
        assert!(norm(&(x - Vector::<f64, 2>::new(0.6, 0.8))) < ROUNDING);
        let back = c.apply_transposed(&x);
        assert!(norm(&(back - Vector::<f64, 2>::new(1.0, 0.0))) < ROUNDING);
    }
}
