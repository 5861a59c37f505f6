//! Rotors at a state: the torque of their inertia on both bodies of the joint, and their kinetic energy.
//!
//! ```text
//! torque -inertia q'' on the coordinate q,   kinetic energy E = inertia q'^2 / 2       inertia: at the joint, gear ratio included
//! ```

use super::coupled_sum::Part;
use super::wrench::Applied;
use crate::Real;
use crate::laws::scalar::ScalarForce;
use crate::mechanism::{RotorInput, Scene};
use crate::model::State;
use crate::natural::NaturalModel;
use alloc::vec::Vec;

/// Torque of an enabled rotor of a scene.
#[derive(Debug, Clone)]
pub(super) struct RotorTorque<T: Real, const D: usize> {
    /// Index of the effect in the scene.
    pub(super) effect: usize,
    inertia: T,
    unknown: usize,
    of: Part<T, D>,
}

impl<T: Real, const D: usize> RotorTorque<T, D> {
    /// All enabled rotors of a checked scene.
    pub(super) fn all(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Vec<Self> {
        let rotors = RotorInput::all(scene).filter_map(|rotor| {
            let RotorInput { effect, joint, number, inertia } = rotor;
            let unknown = model.rotors().iter().find(|at| at.effect == effect)?.unknown;
            let of = Part::of_coordinate(scene, model, (joint, number))?;
            Some(Self { effect, inertia, unknown, of })
        });
        rotors.collect()
    }

    /// Passes to `take` the wrenches on the bodies of its joint.
    pub(super) fn apply(&self, state: &State<T>, take: &mut dyn FnMut(Applied<T>)) {
        self.of.apply(-self.inertia * state.a[self.unknown], state, take);
    }

    /// Coordinate of the joint, its rate, and the torque that opposes an increase of the coordinate.
    pub(super) fn scalar(&self, state: &State<T>) -> ScalarForce<T> {
        let [value, rate] = self.of.measure(state);
        let tension = self.inertia * state.a[self.unknown];
        ScalarForce { value, rate, tension, ..ScalarForce::default() }
    }

    /// Kinetic energy of the rotor [J].
    pub(super) fn kinetic_energy(&self, state: &State<T>) -> T {
        let rate = state.v[self.unknown];
        self.inertia * rate * rate * T::HALF
    }

    /// Power that the rotor supplies to bodies [W].
    pub(super) fn power(&self, state: &State<T>) -> T {
        -self.inertia * state.a[self.unknown] * state.v[self.unknown]
    }
}

/// The kinetic energy of rotors [J].
pub(super) fn kinetic_energy<T: Real, const D: usize>(
    rotors: &[RotorTorque<T, D>],
    state: &State<T>,
) -> T {
    rotors.iter().fold(T::ZERO, |sum, rotor| sum + rotor.kinetic_energy(state))
}
