//! Curves in tables: functions of the numbers that couplings, sums and signals measure.

use crate::link::indexing::{Outside, at, part, range};
use crate::link::plan::Span;
use mbs_core::Real;
use mbs_core::elements::NONE;
use mbs_core::measure::{polynomial, spline_curve};

/// Are curves of couplings and sums in this build?
pub const IS_BUILT: bool = cfg!(feature = "curves");

/// A twice differentiable function.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveTable<T> {
    /// A cubic spline.
    Spline {
        /// Knots of the spline.
        knots: Span,
        /// The first of its second derivatives, as many as knots.
        first: u32,
        /// Period of the spline; zero: it has none.
        period: T,
    },
    /// A polynomial.
    Polynomial {
        /// Coefficients of the polynomial, the constant one first.
        coefficients: Span,
    },
}

/// Curves, knots of splines, and second derivatives of splines at their knots with coefficients of polynomials.
pub type CurveSlices<'a, T> = (&'a [CurveTable<T>], &'a [[T; 2]], &'a [T]);

/// f, f' and f'' of a curve.
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
