//! Curves in tables: functions of what couplings, sums and signals measure.

use crate::coupled::{Couplings, NONE};
use crate::indexing::{Outside, at, part, range};
#[cfg(feature = "alloc")]
use crate::loops::index;
use crate::plan::Span;
use crate::space::Space;
#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use mbs_core::Real;
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
        /// Its knots.
        knots: Span,
        /// The first of its second derivatives, as many as knots.
        first: u32,
        /// Its period; zero: it has none.
        period: T,
    },
    /// A polynomial.
    Polynomial {
        /// Its coefficients, the constant one first.
        coefficients: Span,
    },
}

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// f, f' and f'' of a term's curve.
    pub(crate) fn function(&self, curve: u32, x: T) -> Result<[T; 3], Outside> {
        if curve == NONE {
            return Ok([x, T::ONE, T::ZERO]);
        }
        Ok(match *at(self.curves, curve as usize)? {
            CurveTable::Spline { knots, first, period } => {
                let knots = range(self.knots, knots.range())?;
                let curvature = part(self.numbers, first as usize, knots.len())?;
                spline_curve(knots, curvature, period, x)
            }
            CurveTable::Polynomial { coefficients } => {
                polynomial(range(self.numbers, coefficients.range())?, x)
            }
        })
    }

    /// How many slopes an evaluation remembers: one for each term up to the last that has a curve.
    #[must_use]
    pub fn n_slopes(&self) -> usize {
        let last = self.terms.iter().rposition(|term| term.curve != NONE);
        last.map_or(0, |last| last + 1)
    }
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
    /// A copy of the curves of couplings, with their numbers.
    #[must_use]
    pub fn copied<S: Space<T>>(of: &Couplings<'_, T, S>) -> Self {
        let Couplings { curves, knots, numbers, .. } = of;
        Self { curves: curves.to_vec(), knots: knots.to_vec(), numbers: numbers.to_vec() }
    }

    /// Adds a curve; its number.
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

    /// Couplings with these curves.
    #[must_use]
    pub fn with<'a, S: Space<T>>(&'a self, of: &Couplings<'a, T, S>) -> Couplings<'a, T, S> {
        Couplings { curves: &self.curves, knots: &self.knots, numbers: &self.numbers, ..*of }
    }
}

/// Adds a list to another; where it stands there.
#[cfg(feature = "alloc")]
fn extend<X: Copy>(to: &mut Vec<X>, list: &[X]) -> Span {
    let first = index(to.len());
    to.extend_from_slice(list);
    Span { first, end: index(to.len()) }
}
