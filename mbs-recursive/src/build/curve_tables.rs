//! Tables of curves, filled while a tree is built.

use crate::link::curves::{CurveSlices, CurveTable};
use crate::link::plan::Span;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::elements::NONE;
use mbs_core::measure::PreparedCurve;

/// Tables that own the data of curves. Curves are added one at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveTables<T> {
    curves: Vec<CurveTable<T>>,
    knots: Vec<[T; 2]>,
    numbers: Vec<T>,
}

impl<T> Default for CurveTables<T> {
    fn default() -> Self {
        Self { curves: Vec::new(), knots: Vec::new(), numbers: Vec::new() }
    }
}

impl<T: Real> CurveTables<T> {
    /// Makes a copy of curves with their numbers.
    #[must_use]
    pub fn copied((curves, knots, numbers): CurveSlices<'_, T>) -> Self {
        Self { curves: curves.to_vec(), knots: knots.to_vec(), numbers: numbers.to_vec() }
    }

    /// Returns the curves, with their knots and numbers.
    #[must_use]
    pub fn slices(&self) -> CurveSlices<'_, T> {
        (&self.curves, &self.knots, &self.numbers)
    }

    /// Adds a curve to the tables and returns the index of the curve.
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

/// Appends a list to another list. Returns the range of the appended entries.
fn extend<X: Copy>(to: &mut Vec<X>, list: &[X]) -> Span {
    let first = index(to.len());
    to.extend_from_slice(list);
    Span { first, end: index(to.len()) }
}

fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
