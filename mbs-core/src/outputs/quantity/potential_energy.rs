//! Potential energy of gravity and effects.

use super::super::inertia::{self, BodyInertia};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::algebra::Vector;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "potential-energy",
    TargetKind::Scene,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "-Σ s m g·c + Σ V",
        axes: "none: a number",
        sign: "gravity is zero at the origin of the scene",
        contents: "Gravity and what effects store; s is the `gravity_scale` of the body.",
    },
)
.of_effects();

/// Bodies of the scene, and gravity [m/s^2].
#[derive(Debug, Clone)]
pub(in crate::outputs) struct PotentialEnergy<T: Real, const D: usize>(
    Vec<BodyInertia<T, D>>,
    Vector<T, 3>,
);

impl<T: Real, const D: usize> Measured<T, D> for PotentialEnergy<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        let gravity = from.scene.gravity.map_or_else(Vector::zeros, Vector::from);
        Self(from.bodies(), gravity)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = inertia::potential_energy(&self.0, &self.1, now.state)
            + now.effects.map_or(T::ZERO, |all| all.energy(None, now.state));
    }
}
