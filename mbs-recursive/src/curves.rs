//! Curves in tables: functions of the numbers that couplings, sums and signals measure.

use crate::indexing::{Outside, at, part, range};
use crate::plan::Span;
#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::elements::NONE;
#[cfg(feature = "alloc")]
use mbs_core::measure::PreparedCurve;
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

/// The owner of curves, which are added one by one.
#[cfg(feature = "alloc")]
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTables<T> {
    curves: Vec<CurveTable<T>>,
    knots: Vec<[T; 2]>,
    numbers: Vec<T>,
}

#[cfg(feature = "alloc")]
impl<T> Default for CurveTables<T> {
    fn default() -> Self {
        Self { curves: Vec::new(), knots: Vec::new(), numbers: Vec::new() }
    }
}

#[cfg(feature = "alloc")]
impl<T: Real> CurveTables<T> {
    /// A copy of curves, with their numbers.
    #[must_use]
    pub fn copied((curves, knots, numbers): CurveSlices<'_, T>) -> Self {
        Self { curves: curves.to_vec(), knots: knots.to_vec(), numbers: numbers.to_vec() }
    }

    /// Returns the curves, with their knots and numbers.
    #[must_use]
    pub fn slices(&self) -> CurveSlices<'_, T> {
        (&self.curves, &self.knots, &self.numbers)
    }

    /// Adds a curve; returns its number.
    pub fn add(&mut self, curve: &PreparedCurve<T>) -> u32 {
        let table = match curve {
            PreparedCurve::Identity => return NONE,
            PreparedCurve::Spline { knots, curvature, period } => CurveTable::Spline {
                knots: extend(&mut self.knots, knots),
                first: extend(&mut self.numbers, curvature).first,
                period: *period,
            },
            PreparedCurve::Polynomial(coefficients) => {
                CurveTable::Polynomial { coefficients: extend(&mut self.numbers, coefficients) }
            }
        };
        self.curves.push(table);
        index(self.curves.len() - 1)
    }
}

/// Adds a list to another; where it stands there.
#[cfg(feature = "alloc")]
fn extend<X: Copy>(to: &mut Vec<X>, list: &[X]) -> Span {
    let first = index(to.len());
    to.extend_from_slice(list);
    Span { first, end: index(to.len()) }
}

#[cfg(feature = "alloc")]
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
