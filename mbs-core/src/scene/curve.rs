//! Curves, which are functions of one number, and interpolations of tables.

use crate::Real;
use alloc::vec::Vec;

/// Function of one number, such as the characteristic of a cam.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve<T> {
    /// Natural cubic spline through rows (x, f). Before the first and after the last row the end value is held.
    Table(Vec<[T; 2]>),
    /// Periodic cubic spline through rows (x, f). The last value must equal the first.
    Periodic(Vec<[T; 2]>),
    /// Polynomial c0 + c1 x + c2 x^2 + ...
    Polynomial(Vec<T>),
    /// Rows (x, f) connected by another shape than a spline.
    Shaped {
        /// The rows (x, f).
        rows: Vec<[T; 2]>,
        /// Shape of the curve between the rows.
        shape: CurveShape,
        /// True if the curve repeats. Its last value must then equal its first.
        periodic: bool,
    },
}

/// Shape of a table between its rows, if the table is no spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveShape {
    /// Twice differentiable function that stays between the values of neighbouring rows.
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
    /// Ends without curvature (natural spline). The slope at the ends need not be zero.
    #[default]
    Natural,
    /// Ends at rest (clamped spline), with rate zero at both ends.
    Level,
}

impl<T> Curve<T> {
    /// True if the curve is a table whose values are zero or negative, and not all zero.
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

    /// True if the curve has corners, where its slope jumps.
    #[must_use]
    pub const fn has_corners(&self) -> bool {
        matches!(self, Self::Shaped { shape: CurveShape::Linear, .. })
    }
}
