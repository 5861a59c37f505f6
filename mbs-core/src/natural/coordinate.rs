//! Points and directions by which a joint coordinate is measured, for constraints, guides, effects and outputs.
//!
//! ```text
//! angle      atan2(x2.y, x1.y)   x1, x2 in one body, y in the other
//! slide      x.y                 x from the first body's point to the second's, y in the first
//! rotation   log(R1^T R2)        R1, R2: rotations of the bodies; rate omega2 - omega1, in global axes
//! ```

use super::affine::Affine;
use super::basis::Combination;
use super::build::Builder;
use super::model::NaturalModel;
use super::row_builder::difference;
use crate::Real;
use crate::algebra::Vector;
use crate::joint::{Dimension, Freedom};
use crate::scene::{BodyId, Joint};

/// Points and directions by which a joint coordinate is measured.
#[derive(Debug, Clone)]
pub(crate) enum Coordinate<T, X> {
    /// Angle of y in the frame x1, x2, times `sign`.
    Angle { x1: X, x2: X, y: X, sign: T },
    /// Slide of two points along a direction, x.y.
    Slide { x: X, y: X },
    /// Rotation of the second body against the first.
    Rotation,
}

/// Points and directions of bodies in terms of natural coordinates.
pub(crate) trait Places<T: Real> {
    type Place;

    fn direction(&mut self, body: BodyId, d: Vector<T, 3>) -> Self::Place;

    /// Vector from the joint's point on the first body to its point on the second.
    fn gap(&mut self, joint: &Joint<T>) -> Self::Place;

    /// Coordinate of a joint's freedom.
    fn coordinate(
        &mut self,
        joint: &Joint<T>,
        dimension: Dimension,
        freedom: Freedom,
    ) -> Coordinate<T, Self::Place> {
        match freedom {
            Freedom::Slide(axis) => {
                let x = self.gap(joint);
                Coordinate::Slide { x, y: self.direction(joint.bodies[0], joint.direction(axis)) }
            }
            Freedom::Turn(axis) => {
                let [v, w, y] = joint.turn_directions(dimension, axis);
                let side = joint.side_of_turn(dimension, axis);
                let (own, other) = (joint.bodies[side], joint.bodies[1 - side]);
                Coordinate::Angle {
                    x1: self.direction(own, v),
                    x2: self.direction(own, w),
                    y: self.direction(other, y),
                    sign: if side == 0 { T::ONE } else { -T::ONE },
                }
            }
            Freedom::Ball => Coordinate::Rotation,
        }
    }
}

impl<T: Real> Places<T> for Builder<'_, T> {
    type Place = Combination<T>;

    fn direction(&mut self, body: BodyId, d: Vector<T, 3>) -> Combination<T> {
        Builder::direction(self, body, d)
    }

    fn gap(&mut self, joint: &Joint<T>) -> Combination<T> {
        let second = self.point(joint.bodies[1], joint.points[1]);
        let first = self.point(joint.bodies[0], joint.points[0]);
        difference(&second, &first)
    }
}

impl<T: Real, const D: usize> Places<T> for &NaturalModel<T, D> {
    type Place = Affine<T, D>;

    fn direction(&mut self, body: BodyId, d: Vector<T, 3>) -> Affine<T, D> {
        NaturalModel::direction(self, body, d.into())
    }

    fn gap(&mut self, joint: &Joint<T>) -> Affine<T, D> {
        let [first, second] = [0, 1].map(|i| self.point(joint.bodies[i], joint.points[i]));
        second.minus(&first)
    }
}
