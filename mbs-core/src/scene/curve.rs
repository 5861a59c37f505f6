//! Curves: twice differentiable functions of one number.

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
