//! Kinetic energy of all bodies and rotors.

use super::super::inertia::{self, BodyInertia};
use super::super::rotor::{self, RotorTorque};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "kinetic-energy",
    TargetKind::Scene,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "Σ (m c'·c' + ω·I ω)/2 + Σ J q'^2/2",
        axes: "none: a number",
        sign: "never negative",
        contents: "Bodies and rotors.",
    },
);

/// Bodies and rotors of the scene.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct KineticEnergy<T: Real, const D: usize>(
    Vec<BodyInertia<T, D>>,
    Vec<RotorTorque<T, D>>,
);

impl<T: Real, const D: usize> Measured<T, D> for KineticEnergy<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        Self(from.bodies(), from.rotors())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] =
            inertia::kinetic_energy(&self.0, now.state) + rotor::kinetic_energy(&self.1, now.state);
    }
}
