//! Measured numbers of a mechanism, and terms of their sums.

use crate::scene::{BodyId, Curve, JointId, Number, Vector3};
use alloc::vec::Vec;

/// Term of a coupling: `factor` times a measured number, or times a curve of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingTerm<T> {
    /// Factor of the number or of the curve.
    pub factor: T,
    /// Number that is measured.
    pub of: CouplingMeasure<T>,
    /// Function of the number that the term uses; `None`: the number itself.
    pub curve: Option<Curve<T>>,
}

/// Measured number of a mechanism, which is zero in the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub enum CouplingMeasure<T> {
    /// Coordinate of a joint [rad or m]. Angles include full turns.
    Coordinate {
        /// Joint of the coordinate.
        joint: JointId,
        /// Place of the coordinate among those of the joint, from 0.
        number: usize,
    },
    /// Length of a line through points of bodies, less its length in the reference configuration [m].
    Length {
        /// Points of the line, reference configuration [m].
        points: Vec<(BodyId, [T; 3])>,
    },
    /// Angle of a ball joint, zero in the reference configuration [rad]. Couplings cannot use it. Signals can use only the swing.
    Ball {
        /// Joint with the ball.
        joint: JointId,
        /// Angle of the ball: its swing or its twist.
        angle: BallAngle,
        /// Direction that is fixed in the first body. The second body has the same direction in the reference configuration.
        axis: [T; 3],
    },
}

/// Angle of a ball joint. An axis is `a` in the first body and `b` in the second, equal in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BallAngle {
    /// The angle between `a` and `b`, from 0 to pi.
    Swing,
    /// The rotation about the axis that remains after the smallest rotation from `a` to `b` is removed.
    Twist,
}

impl BallAngle {
    /// All angles of a ball.
    pub const ALL: [Self; 2] = [Self::Swing, Self::Twist];

    /// Name of the angle in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Swing => "swing",
            Self::Twist => "twist",
        }
    }
}

impl From<JointId> for CouplingMeasure<Number> {
    fn from(joint: JointId) -> Self {
        Self::Coordinate { joint, number: 0 }
    }
}

impl From<(JointId, usize)> for CouplingMeasure<Number> {
    fn from((joint, number): (JointId, usize)) -> Self {
        Self::Coordinate { joint, number }
    }
}

impl CouplingMeasure<Number> {
    /// Length of a line through points of bodies [m].
    #[must_use]
    pub fn line<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        Self::Length { points: points.into_iter().map(|(body, at)| (body, at.into().0)).collect() }
    }
}

impl<T> CouplingMeasure<T> {
    /// Joint of the measured number; `None` for a length.
    #[must_use]
    pub const fn joint(&self) -> Option<JointId> {
        match self {
            Self::Coordinate { joint, .. } | Self::Ball { joint, .. } => Some(*joint),
            Self::Length { .. } => None,
        }
    }

    /// Joint and number of the coordinate; `None` for a length, and for an angle of a ball joint.
    #[must_use]
    pub const fn coordinate(&self) -> Option<(JointId, usize)> {
        match self {
            Self::Coordinate { joint, number } => Some((*joint, *number)),
            Self::Length { .. } | Self::Ball { .. } => None,
        }
    }
}

impl CouplingTerm<Number> {
    /// Term of an angle of a ball joint, with the axis in the reference configuration.
    pub fn of_ball(
        joint: JointId,
        angle: BallAngle,
        axis: impl Into<Vector3>,
        factor: impl Into<Number>,
    ) -> Self {
        let of = CouplingMeasure::Ball { joint, angle, axis: axis.into().0 };
        Self { factor: factor.into(), of, curve: None }
    }

    /// Term of the coordinate `number` of a joint, times a factor.
    pub fn of_joint(joint: JointId, number: usize, factor: impl Into<Number>) -> Self {
        let of = CouplingMeasure::Coordinate { joint, number };
        Self { factor: factor.into(), of, curve: None }
    }
}
