//! Curves: twice differentiable functions of one number.

use crate::Real;
use alloc::vec::Vec;

/// A twice differentiable function.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve<T> {
    /// The natural cubic spline through (x, f); the end values are held outside.
    Table(Vec<[T; 2]>),
    /// The periodic cubic spline through (x, f); the last value is the first.
    Periodic(Vec<[T; 2]>),
    /// c0 + c1 x + c2 x^2 + ...
    Polynomial(Vec<T>),
}

/// How the spline of a table begins and ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableEnds {
    /// Without curvature: the natural spline, which ends on a slope.
    #[default]
    Natural,
    /// At rest: the clamped spline, with no rate at both ends.
    Level,
}

impl<T> Curve<T> {
    /// Is it a table of values that are zero or below, and not all zero?
    #[must_use]
    pub fn is_below_zero(&self) -> bool
    where
        T: Real,
    {
        let (Self::Table(rows) | Self::Periodic(rows)) = self else { return false };
        rows.iter().all(|row| row[1] <= T::ZERO) && rows.iter().any(|row| row[1] < T::ZERO)
    }
}
