//! Two meshing wheels: their bodies, and the pitch point in the reference configuration.
//!
//! ```text
//! pitch point O1 + a e:  a = D / (1 + w2/w1)     O1: point on the first axis, e: unit vector to the second axis, D: distance of the axes
//!                                                w1, w2: moments on the wheels about parallel axes of one sense, for an effort of one
//! ```

use crate::Real;
use crate::algebra::{Vector, along, cross, norm};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::scene::{BodyId, CouplingMeasure, CouplingTerm};

/// Two meshing wheels on parallel axes in one body, from a coupling of two terms.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct MeshedWheels<T: Real> {
    /// Body that carries both wheels.
    pub(crate) carrier: BodyId,
    /// Bodies of the two wheels.
    pub(crate) wheels: [BodyId; 2],
    /// Moment on each wheel about its joint's axis for an effort of one.
    pub(crate) moments: [T; 2],
    /// Axes of the two joints, and a point on each axis [m], in the reference configuration.
    pub(super) axes: [Vector<T, 3>; 2],
    pub(super) points: [Vector<T, 3>; 2],
}

impl<T: Real> MeshedWheels<T> {
    /// Meshing wheels of a coupling. `None` unless its terms are two turns about parallel axes in one body, and the distance of the axes is
    /// not zero.
    pub(crate) fn new(scene: &Scene<T>, terms: &[CouplingTerm<T>]) -> Option<Self> {
        /// Largest sine of the angle between parallel axes [-]. Chosen, not tuned: numbers in files are rounded.
        const PARALLEL: f64 = 1e-6;
        let [first, second] = terms else { return None };
        let joints = [first, second].map(|term| match (&term.of, &term.curve) {
            (&CouplingMeasure::Coordinate { joint, number }, None) => Some((joint, number)),
            _ => None,
        });
        let [Some(a), Some(b)] = joints else { return None };
        let [j, k] = [a.0, b.0].map(|joint| scene.joints.get(joint.index()));
        let (j, k) = (j?, k?);
        let carrier = j.shared_body(k)?;
        let mut wheels = Self {
            carrier,
            wheels: [carrier; 2],
            moments: [first.factor, second.factor],
            axes: [Vector::zeros(); 2],
            points: [j.points[0], k.points[0]].map(Vector::from),
        };
        for (i, (joint, number)) in [(j, a.1), (k, b.1)].into_iter().enumerate() {
            let Some(Freedom::Turn(axis)) = joint.kind.freedom(scene.dimension, number) else {
                return None;
            };
            let freedoms = joint.freedoms(scene.dimension).iter();
            // with two turns, no axis is fixed in both bodies
            if freedoms.filter(|freedom| matches!(freedom, Freedom::Turn(_))).count() > 1 {
                return None;
            }
            wheels.axes[i] = along(&joint.direction(axis));
            let side = usize::from(joint.bodies[0] == carrier);
            wheels.wheels[i] = joint.bodies[side];
            if side == 0 {
                wheels.moments[i] = -wheels.moments[i];
            }
        }
        let sine = norm(&cross(&wheels.axes[0], &wheels.axes[1]));
        let is_mesh = sine <= T::from_f64(PARALLEL)
            && wheels.distance() > T::ZERO
            && wheels.moments.iter().all(|moment| !moment.is_zero());
        is_mesh.then_some(wheels)
    }

    /// Vector from the first axis to the second, perpendicular to them [m].
    fn between(&self) -> Vector<T, 3> {
        let (way, axis) = (self.points[1] - self.points[0], self.axes[0]);
        way - axis * axis.dot(&way)
    }

    /// Distance of the axes [m].
    pub(crate) fn distance(&self) -> T {
        norm(&self.between())
    }

    /// Pitch point [m], at the same position along the axes as `at`. It is not finite for wheels of equal moments that turn in the same
    /// sense.
    pub(crate) fn pitch_point(&self, at: &Vector<T, 3>) -> Vector<T, 3> {
        let axis = self.axes[0];
        let sense = if axis.dot(&self.axes[1]) < T::ZERO { -T::ONE } else { T::ONE };
        let share = T::ONE / (T::ONE + sense * self.moments[1] / self.moments[0]);
        let first = self.points[0];
        first + axis * axis.dot(&(at - first)) + self.between() * share
    }
}
