//! Curves, functions of one number, and how tables go between their rows.

use crate::Real;
use alloc::vec::Vec;

/// A function of one number.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve<T> {
    /// The natural cubic spline through (x, f); the end values are held outside.
    Table(Vec<[T; 2]>),
    /// The periodic cubic spline through (x, f); the last value is the first.
    Periodic(Vec<[T; 2]>),
    /// c0 + c1 x + c2 x^2 + ...
    Polynomial(Vec<T>),
    /// Through (x, f) without a spline.
    Shaped {
        /// The rows (x, f).
        rows: Vec<[T; 2]>,
        /// Shape of the curve between the rows.
        shape: CurveShape,
        /// Does the curve repeat? Its last value is then its first.
        periodic: bool,
    },
}

/// Shape of a table between its rows where it is no spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveShape {
    /// Twice differentiable, between the values of the neighbouring rows.
    Monotone,
    /// Straight lines between the rows.
    Linear,
}

impl CurveShape {
    /// Name of the shape in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Monotone => "monotone",
            Self::Linear => "linear",
        }
    }
}

/// Condition at both ends of a spline or a monotone table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TableEnds {
    /// Ends without curvature: the natural spline, which ends on a slope.
    #[default]
    Natural,
    /// Ends at rest: the clamped spline, with no rate at both ends.
    Level,
}

impl<T> Curve<T> {
    /// Is it a table of values that are zero or below, and not all zero?
    #[must_use]
    pub fn is_below_zero(&self) -> bool
    where
        T: Real,
    {
        let (Self::Table(rows) | Self::Periodic(rows) | Self::Shaped { rows, .. }) = self else {
            return false;
        };
        rows.iter().all(|row| row[1] <= T::ZERO) && rows.iter().any(|row| row[1] < T::ZERO)
    }

    /// Has it corners, at which its slope jumps?
    #[must_use]
    pub const fn has_corners(&self) -> bool {
        matches!(self, Self::Shaped { shape: CurveShape::Linear, .. })
    }
}
