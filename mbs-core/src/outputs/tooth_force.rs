//! Force of the teeth of two meshing wheels at their pitch point.
//!
//! ```text
//! r_k            vector from the axis n_k of wheel k to the pitch point, perpendicular to the axis
//! f = w1 (n1 x r1)/|r1|^2       on the first wheel, -f on the second: its moments w1 about n1, w2 about n2 are those of the coupling
//! |f| tan(alpha)                pushes the teeth apart: towards the axis of the smaller wheel on that wheel, opposite on the other wheel
//! ```
//!
//! alpha is the pressure angle. The force that pushes the teeth apart has no moment about the axes. It changes the loads of bearings, but
//! neither the motion nor the effort.

use super::coordinate::Coordinate;
use super::wrench::{Applied, Wrench};
use crate::Real;
use crate::algebra::{Vector, cross, norm, raised};
use crate::mechanism::{MeshedWheels, Scene};
use crate::model::State;
use crate::natural::{Affine, NaturalModel};
use crate::scene::{BodyId, Coupling, CouplingKind};

/// Force of the teeth of two meshing wheels.
#[derive(Debug, Clone)]
pub(super) struct ToothForce<T: Real, const D: usize> {
    wheels: [BodyId; 2],
    /// Pitch point in the body that carries the wheels.
    pitch: Affine<T, D>,
    /// Coordinate of each joint, which has the axis, and the joint's point.
    axes: [(Coordinate<T, D>, Affine<T, D>); 2],
    /// Moment on the first wheel for an effort of one.
    moment: T,
    /// Factor tan(alpha) of the force that pushes the teeth apart.
    apart: T,
}

impl<T: Real, const D: usize> ToothForce<T, D> {
    /// Force of a coupling in a checked scene; `None` if the coupling has no pitch point.
    pub(super) fn new(
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
        coupling: &Coupling<T>,
    ) -> Option<Self> {
        let CouplingKind::Mesh(mesh) = &coupling.kind else { return None };
        let wheels = MeshedWheels::new(scene, &coupling.terms)?;
        let axis = |term: usize| {
            let of = coupling.terms[term].of.coordinate()?;
            Coordinate::carried((scene, model), of, wheels.carrier)
        };
        let (sine, cosine) = mesh.pressure_angle.sin_cos();
        Some(Self {
            wheels: wheels.wheels,
            pitch: model.point(wheels.carrier, mesh.at),
            axes: [axis(0)?, axis(1)?],
            moment: wheels.moments[0],
            apart: sine / cosine,
        })
    }

    /// Pitch point, the vectors to it from the axes, and the tangential force on the first wheel for an effort.
    fn at(&self, effort: T, state: &State<T>) -> (Vector<T, 3>, [Vector<T, 3>; 2], Vector<T, 3>) {
        let pitch = raised(&self.pitch.value(&state.q));
        let axes = self.axes.each_ref().map(|(axis, place)| {
            let n = axis.direction(&state.q).moment;
            let way = pitch - raised(&place.value(&state.q));
            (n, way - n * n.dot(&way))
        });
        let [(n, way), (_, other)] = axes;
        let force = cross(&n, &way) * (self.moment * effort / way.dot(&way));
        (pitch, [way, other], force)
    }

    /// Passes to `take` the wrenches that turn the wheels at an effort.
    pub(super) fn apply(&self, effort: T, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        let (pitch, _, force) = self.at(effort, state);
        self.hand_out(pitch, force, take);
    }

    /// Passes to `take` the forces that push the wheels apart at an effort. There are none without a pressure angle.
    pub(super) fn drive_apart(
        &self,
        effort: T,
        state: &State<T>,
        take: &mut dyn FnMut(Applied<T>),
    ) {
        if self.apart.is_zero() {
            return;
        }
        let (pitch, ways, force) = self.at(effort, state);
        let [first, second] = ways.each_ref().map(norm);
        // direction of the force on the first wheel; on the smaller wheel it points towards the axis
        let on_first =
            if first <= second { ways[0] * (-T::ONE / first) } else { ways[1] * (T::ONE / second) };
        self.hand_out(pitch, on_first * (norm(&force) * self.apart), take);
    }

    /// Passes to `take` a force on the first wheel at the pitch point, and the opposite force on the second.
    fn hand_out(&self, pitch: Vector<T, 3>, force: Vector<T, 3>, take: &mut dyn FnMut(Applied<T>)) {
        let wrench = Wrench { force, moment: Vector::zeros() };
        take((self.wheels[0], Some(pitch), wrench));
        take((self.wheels[1], Some(pitch), wrench.scaled(-T::ONE)));
    }
}
