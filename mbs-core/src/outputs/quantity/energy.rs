//! Total energy: kinetic and potential energy of bodies, rotors and effects.

use super::super::inertia::{self, BodyInertia};
use super::super::rotor::{self, RotorTorque};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::algebra::Vector;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "energy",
    TargetKind::Scene,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "kinetic + potential energy",
        axes: "none: a number",
        sign: "as its parts",
        contents: "",
    },
)
.of_effects();

/// Bodies and rotors of the scene, and gravity [m/s^2].
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Energy<T: Real, const D: usize>(
    Vec<BodyInertia<T, D>>,
    Vec<RotorTorque<T, D>>,
    Vector<T, 3>,
);

impl<T: Real, const D: usize> Measured<T, D> for Energy<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        let gravity = from.scene.gravity.map_or_else(Vector::zeros, Vector::from);
        Self(from.bodies(), from.rotors(), gravity)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = inertia::kinetic_energy(&self.0, now.state)
            + rotor::kinetic_energy(&self.1, now.state)
            + inertia::potential_energy(&self.0, &self.2, now.state)
            + now.effects.map_or(T::ZERO, |all| all.energy(None, now.state));
    }
}
