//! Curves prepared for evaluation: tables as splines, and polynomials.

use super::monotone::monotone;
use crate::Real;
use crate::laws::guide;
use crate::measure::{polynomial, polynomial_change, spline_change, spline_curve};
use crate::scene::{Curve, Interpolation, TableEnds};
use alloc::vec;
use alloc::vec::Vec;

/// A curve with its spline prepared.
#[derive(Debug, Clone, PartialEq)]
pub enum PreparedCurve<T> {
    /// The identity f(x) = x.
    Identity,
    /// Piecewise cubic function of x.
    Spline {
        /// Knots (x, f) of the function.
        knots: Vec<[T; 2]>,
        /// Second derivatives at the knots.
        curvature: Vec<T>,
        /// Period of the function; zero: the function is not periodic.
        period: T,
    },
    /// Polynomial with these coefficients, the constant one first.
    Polynomial(Vec<T>),
}

impl<T: Real> PreparedCurve<T> {
    /// Prepares a curve for evaluation. `None` gives the identity. Cost: one tridiagonal elimination.
    #[must_use]
    pub fn new(curve: Option<&Curve<T>>) -> Self {
        match curve {
            None => Self::Identity,
            Some(Curve::Polynomial(coefficients)) => Self::Polynomial(coefficients.clone()),
            Some(Curve::Table(rows)) => Self::table(rows, SPLINE, false),
            Some(Curve::Periodic(rows)) => Self::table(rows, SPLINE, true),
            Some(Curve::Shaped { rows, shape, periodic }) => {
                Self::table(rows, (*shape).into(), *periodic)
            }
        }
    }

    /// Prepares a table for evaluation. A table with interpolation `hold` becomes linear between its rows.
    ///
    /// Cost: one tridiagonal elimination.
    #[must_use]
    pub fn table(rows: &[[T; 2]], way: Interpolation, is_periodic: bool) -> Self {
        let period = match rows {
            [first, .., last] if is_periodic => last[0] - first[0],
            _ => T::ZERO,
        };
        let (knots, curvature) = knots(rows, way, is_periodic);
        Self::Spline { knots, curvature, period }
    }

    /// Value f, f' and f'' at `x`.
    #[must_use]
    pub fn at(&self, x: T) -> [T; 3] {
        match self {
            Self::Identity => [x, T::ONE, T::ZERO],
            Self::Spline { knots, curvature, period } => spline_curve(knots, curvature, *period, x),
            Self::Polynomial(coefficients) => polynomial(coefficients, x),
        }
    }

    /// Difference f(x + dx) - f(x), without cancellation of digits.
    #[must_use]
    pub fn change(&self, x: T, dx: T) -> T {
        match self {
            Self::Identity => dx,
            Self::Spline { knots, curvature, period } => {
                spline_change((knots, curvature), *period, x, dx)
            }
            Self::Polynomial(coefficients) => polynomial_change(coefficients, x, dx),
        }
    }

    /// True if the slope can be zero over a range of x: between two rows, or outside a table without period.
    #[must_use]
    pub fn may_be_level(&self) -> bool {
        let Self::Spline { knots, curvature, period } = self else { return false };
        let is_flat = |i: usize| {
            knots[i][1] == knots[i + 1][1] && [i, i + 1].iter().all(|&i| curvature[i].is_zero())
        };
        !(*period > T::ZERO) || (1..knots.len()).any(|i| is_flat(i - 1))
    }

    /// True if the curve is the identity f(x) = x.
    #[must_use]
    pub const fn is_identity(&self) -> bool {
        matches!(self, Self::Identity)
    }
}

/// Interpolation by a natural spline.
const SPLINE: Interpolation = Interpolation::Spline(TableEnds::Natural);

/// Knots and second derivatives of the piecewise cubic function of a table, as [`guide::spline`] needs them.
pub(crate) fn knots<T: Real>(
    rows: &[[T; 2]],
    way: Interpolation,
    is_periodic: bool,
) -> (Vec<[T; 2]>, Vec<T>) {
    let mut curvature = vec![T::ZERO; rows.len()];
    let Some(ends) = way.ends() else { return (rows.to_vec(), curvature) };
    if is_periodic {
        curvature = periodic_curvatures(rows);
    } else {
        let mut scratch = vec![T::ZERO; rows.len()];
        match ends {
            TableEnds::Natural => guide::spline_curvatures(rows, &mut curvature, &mut scratch),
            TableEnds::Level => guide::level_curvatures(rows, &mut curvature, &mut scratch),
        }
    }
    match way {
        Interpolation::Monotone(_) => monotone(rows, curvature, is_periodic),
        _ => (rows.to_vec(), curvature),
    }
}

/// Second derivatives of the periodic cubic spline, one for each knot. Those of the two end knots are equal.
///
/// ```text
/// h_(i-1) c_(i-1) + 2 (h_(i-1) + h_i) c_i + h_i c_(i+1) = 6 ((f_(i+1) - f_i)/h_i - (f_i - f_(i-1))/h_(i-1)),   cyclic
/// ```
///
/// h are the lengths of the intervals, f the values, c the second derivatives. The cyclic matrix is a tridiagonal one plus u v^T with u =
/// (-d, 0 .. 0, h) and v = (1, 0 .. 0, -h/d). It is solved by the formula of Sherman and Morrison.
fn periodic_curvatures<T: Real>(knots: &[[T; 2]]) -> Vec<T> {
    let n = knots.len().saturating_sub(1);
    if n < 2 {
        return vec![T::ZERO; knots.len()];
    }
    let six = T::from_f64(6.0);
    let h: Vec<T> = (0..n).map(|i| knots[i + 1][0] - knots[i][0]).collect();
    let slope: Vec<T> = (0..n).map(|i| (knots[i + 1][1] - knots[i][1]) / h[i]).collect();
    let before = |i: usize| if i == 0 { n - 1 } else { i - 1 };
    let mut diagonal: Vec<T> = (0..n).map(|i| T::TWO * (h[before(i)] + h[i])).collect();
    let mut right: Vec<T> = (0..n).map(|i| six * (slope[i] - slope[before(i)])).collect();
    let (corner, d) = (h[n - 1], diagonal[0]);
    if n == 2 {
        // the two neighbours of each knot are the same knot
        let off = h[0] + h[1];
        let det = diagonal[0] * diagonal[1] - off * off;
        let c0 = (right[0] * diagonal[1] - off * right[1]) / det;
        let c1 = (diagonal[0] * right[1] - off * right[0]) / det;
        return vec![c0, c1, c0];
    }
    diagonal[0] = d + d;
    diagonal[n - 1] += corner * corner / d;
    let mut u = vec![T::ZERO; n];
    (u[0], u[n - 1]) = (-d, corner);
    for i in 1..n {
        let m = h[i - 1] / diagonal[i - 1];
        diagonal[i] -= m * h[i - 1];
        let (r, w) = (right[i - 1], u[i - 1]);
        right[i] -= m * r;
        u[i] -= m * w;
    }
    for x in [&mut right, &mut u] {
        x[n - 1] /= diagonal[n - 1];
        for i in (0..n - 1).rev() {
            let next = x[i + 1];
            x[i] = (x[i] - h[i] * next) / diagonal[i];
        }
    }
    let v = |x: &[T]| x[0] - x[n - 1] * corner / d;
    let part = v(&right) / (T::ONE + v(&u));
    let mut curvature: Vec<T> = right.iter().zip(&u).map(|(&r, &u)| r - u * part).collect();
    curvature.push(curvature[0]);
    curvature
}
