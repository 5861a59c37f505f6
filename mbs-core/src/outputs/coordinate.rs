//! Joint coordinates measured at a state: the same directions and signs that hold them at the start.
//!
//! ```text
//! angle   atan2(x2.y, x1.y)          x1, x2 in one body, y in the other
//! slide   x.y                        x from the first body's point to the second's, y in the first
//! turn    log(R1^T R2),   rate omega2 - omega1 in global axes
//! ```

use super::frame::{Frame, normalised};
use crate::Real;
use crate::algebra::{Vector, cross, norm, rotation_vector, unit};
use crate::natural::{Affine, NaturalModel, angle_directions, joint_axes, unwrap};
use crate::scene::{Joint, JointKind, Scene};
use alloc::boxed::Box;
use alloc::vec::Vec;

/// One coordinate of a joint, or the three of a turn.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Coordinate<T: Real, const D: usize> {
    /// `sign` times the angle of y in the frame x1, x2.
    Angle { x1: Affine<T, D>, x2: Affine<T, D>, y: Affine<T, D>, sign: T },
    /// x.y.
    Slide { x: Affine<T, D>, y: Affine<T, D> },
    /// Rotation of the second body against the first.
    Turn { frames: Box<[Frame<T, D>; 2]> },
}

impl<T: Real, const D: usize> Coordinate<T, D> {
    /// The coordinates of a joint in the order of its numbers.
    pub(super) fn of_joint(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        joint: &Joint<T>,
    ) -> Vec<Self> {
        let [n, d] = joint_axes(joint, scene.dimension);
        let slide = |along| Self::slide(model, joint, along);
        let angle = || Self::angle(scene, model, joint, 0);
        let turn =
            || Self::Turn { frames: Box::new(joint.bodies.map(|b| Frame::new(scene, model, b))) };
        match joint.kind {
            JointKind::Weld | JointKind::Distance => Vec::new(),
            JointKind::Revolute => alloc::vec![angle()],
            JointKind::Prismatic => alloc::vec![slide(n)],
            JointKind::Cylindrical => alloc::vec![slide(n), angle()],
            JointKind::Universal => {
                alloc::vec![angle(), Self::angle(scene, model, joint, 1)]
            }
            JointKind::Planar => {
                let second = cross(&Vector::<T, 3>::from(n), &Vector::from(d));
                alloc::vec![slide(d), slide(second.into()), angle()]
            }
            JointKind::Spherical => alloc::vec![turn()],
            JointKind::Free => {
                let mut all: Vec<Self> = (0..D).map(|i| slide(unit(i).into())).collect();
                all.push(if D == 2 { angle() } else { turn() });
                all
            }
        }
    }

    /// Angle number 0 is that of the second body about an axis of the first; number 1 (the universal joint's second) is
    /// minus that of the first body about an axis of the second.
    pub(super) fn angle(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        joint: &Joint<T>,
        number: usize,
    ) -> Self {
        let [v, w, y] = angle_directions(joint, scene.dimension, number);
        let [frame, turned] =
            if number == 0 { joint.bodies } else { [joint.bodies[1], joint.bodies[0]] };
        Self::Angle {
            x1: model.direction(frame, v),
            x2: model.direction(frame, w),
            y: model.direction(turned, y),
            sign: if number == 0 { T::ONE } else { -T::ONE },
        }
    }

    fn slide(model: &NaturalModel<T, D>, joint: &Joint<T>, along: [T; 3]) -> Self {
        let [first, second] = joint.bodies;
        let [p, q] = joint.points;
        Self::Slide {
            x: model.point(second, q).minus(&model.point(first, p)),
            y: model.direction(first, along),
        }
    }

    /// How many numbers it has.
    pub(super) fn len(&self) -> usize {
        if matches!(self, Self::Turn { .. }) { 3 } else { 1 }
    }

    /// Replaces the last value by the present one, turns counted from the last.
    pub(super) fn track(&self, q: &[T], last: &mut [T]) {
        match self {
            Self::Angle { x1, x2, y, sign } => {
                let y = y.value(q);
                let angle = x2.value(q).dot(&y).atan2(x1.value(q).dot(&y));
                last[0] = unwrap(angle * *sign, last[0]);
            }
            Self::Slide { x, y } => last[0] = x.value(q).dot(&y.value(q)),
            Self::Turn { frames } => {
                let r = frames[0].rotation(q).transpose() * frames[1].rotation(q);
                let w = nearest(&rotation_vector(&r), &Vector::from_fn(|i, _| last[i]));
                last.copy_from_slice(w.as_slice());
            }
        }
    }

    /// Writes the rates at (q, v).
    pub(super) fn rates(&self, q: &[T], v: &[T], out: &mut [T]) {
        match self {
            Self::Angle { x1, x2, y, sign } => {
                let (p1, p2, py) = (x1.value(q), x2.value(q), y.value(q));
                let (w1, w2, wy) = (x1.rate(v), x2.rate(v), y.rate(v));
                let (c, s) = (p1.dot(&py), p2.dot(&py));
                let (c_t, s_t) = (w1.dot(&py) + p1.dot(&wy), w2.dot(&py) + p2.dot(&wy));
                out[0] = *sign * (c * s_t - s * c_t) / (c * c + s * s);
            }
            Self::Slide { x, y } => {
                out[0] = x.rate(v).dot(&y.value(q)) + x.value(q).dot(&y.rate(v));
            }
            Self::Turn { frames } => {
                let omega = frames[1].turning(q, v) - frames[0].turning(q, v);
                out.copy_from_slice(omega.as_slice());
            }
        }
    }
}

/// The rotation vector of the same rotation as `w` that is nearest to `last`: its length may pass half a turn.
fn nearest<T: Real>(w: &Vector<T, 3>, last: &Vector<T, 3>) -> Vector<T, 3> {
    let angle = norm(w);
    // After whole turns the axis of a vanishing angle is rounding: the last one is kept.
    let n = if angle <= T::EPSILON.sqrt() && norm(last) > T::PI {
        normalised(last)
    } else {
        normalised(w)
    };
    n * unwrap(n.dot(w), n.dot(last))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::rotation;

    #[test]
    fn a_rotation_vector_grows_continuously_over_three_turns() {
        let axis = normalised(&Vector::<f64, 3>::new(0.3, -1.0, 0.7));
        let mut last = Vector::<f64, 3>::zeros();
        for i in 0..=600 {
            let angle = f64::from(i) * core::f64::consts::PI / 100.0;
            last = nearest(&rotation_vector(&rotation(&(axis * angle))), &last);
            assert!(norm(&(last - axis * angle)) < 1e-7, "at {angle}: {last}");
        }
    }
}
