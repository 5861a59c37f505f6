//! Numbers that a mechanism has, and terms of sums of them.

use crate::scene::{BodyId, Curve, JointId, Number, Vector3};
use alloc::vec::Vec;

/// A term of a coupling: `factor` times a measured number, or a curve of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingTerm<T> {
    /// Factor of the number, or of its curve.
    pub factor: T,
    /// Number that is measured.
    pub of: CouplingMeasure<T>,
    /// The function of the number that is meant; `None`: the number itself.
    pub curve: Option<Curve<T>>,
}

/// A number that a mechanism has: zero in the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub enum CouplingMeasure<T> {
    /// A coordinate of a joint [rad or m]; angles count their turns.
    Coordinate {
        /// Joint of the coordinate.
        joint: JointId,
        /// The place of the coordinate among the joint's, from 0.
        number: usize,
    },
    /// The length of a line over points of bodies, less that in the reference configuration [m].
    Length {
        /// The points, reference configuration [m].
        points: Vec<(BodyId, [T; 3])>,
    },
    /// An angle of a ball, zero in the reference configuration [rad]; of effects only.
    Ball {
        /// Joint with the ball.
        joint: JointId,
        /// Angle of the ball: its swing or its twist.
        angle: BallAngle,
        /// A direction that is fixed in the first body; and in the second, which has the same in the reference configuration.
        axis: [T; 3],
    },
}

/// An angle of a ball joint, by an axis `a` in the first body and `b` in the second that were one in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BallAngle {
    /// The angle between them, from 0 to pi.
    Swing,
    /// The turn about the axis that is left when the smallest turn that carries `a` to `b` is taken off.
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
    /// The length of a line over points of bodies [m].
    #[must_use]
    pub fn line<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        Self::Length { points: points.into_iter().map(|(body, at)| (body, at.into().0)).collect() }
    }
}

impl<T> CouplingMeasure<T> {
    /// The joint that it is of; `None` of a length.
    #[must_use]
    pub const fn joint(&self) -> Option<JointId> {
        match self {
            Self::Coordinate { joint, .. } | Self::Ball { joint, .. } => Some(*joint),
            Self::Length { .. } => None,
        }
    }

    /// The joint and the number of a coordinate; `None` of a length, and of an angle of a ball.
    #[must_use]
    pub const fn coordinate(&self) -> Option<(JointId, usize)> {
        match self {
            Self::Coordinate { joint, number } => Some((*joint, *number)),
            Self::Length { .. } | Self::Ball { .. } => None,
        }
    }
}

impl CouplingTerm<Number> {
    /// A factor times an angle of a ball joint, by an axis of the reference configuration.
    pub fn of_ball(
        joint: JointId,
        angle: BallAngle,
        axis: impl Into<Vector3>,
        factor: impl Into<Number>,
    ) -> Self {
        let of = CouplingMeasure::Ball { joint, angle, axis: axis.into().0 };
        Self { factor: factor.into(), of, curve: None }
    }

    /// A factor times the coordinate `number` of a joint.
    pub fn of_joint(joint: JointId, number: usize, factor: impl Into<Number>) -> Self {
        let of = CouplingMeasure::Coordinate { joint, number };
        Self { factor: factor.into(), of, curve: None }
    }
}
