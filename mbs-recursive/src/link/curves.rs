//! Curves in tables: functions of one number, used by couplings, effects on sums and signals.

use crate::link::indexing::{Outside, at, part, range};
use crate::link::plan::Span;
use mbs_core::Real;
use mbs_core::elements::NONE;
use mbs_core::measure::{polynomial, spline_curve};

/// True if this build supports curves of couplings and sums.
pub const IS_BUILT: bool = cfg!(feature = "curves");

/// A twice differentiable function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveTable<T> {
    /// A cubic spline through knots.
    Spline {
        /// Knots of the spline.
        knots: Span,
        /// Index in the list of numbers at which the second derivatives of the spline begin. A spline has one second derivative for each
        /// knot.
        first: u32,
        /// Period of the spline; zero means that the spline is not periodic.
        period: T,
    },
    /// A polynomial by its coefficients.
    Polynomial {
        /// Coefficients of the polynomial, beginning with the constant term.
        coefficients: Span,
    },
}

/// Slices of all curves: the curves, the knots of splines, and the numbers of curves. The numbers of a curve are the second derivatives at
/// the knots of a spline or the coefficients of a polynomial.
pub type CurveSlices<'a, T> = (&'a [CurveTable<T>], &'a [[T; 2]], &'a [T]);

/// Evaluates f, f' and f'' of a curve at `x`.
pub(crate) fn function<T: Real>(
    (curves, knots, numbers): CurveSlices<'_, T>,
    curve: u32,
    x: T,
) -> Result<[T; 3], Outside> {
    if curve == NONE {
        return Ok([x, T::ONE, T::ZERO]);
    }
    Ok(match *at(curves, curve as usize)? {
        CurveTable::Spline { knots: own, first, period } => {
            let knots = range(knots, own.range())?;
            let curvature = part(numbers, first as usize, knots.len())?;
            spline_curve(knots, curvature, period, x)
        }
        CurveTable::Polynomial { coefficients } => {
            polynomial(range(numbers, coefficients.range())?, x)
        }
    })
}
