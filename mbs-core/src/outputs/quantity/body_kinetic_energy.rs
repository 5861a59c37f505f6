//! Kinetic energy of a body.

use super::super::inertia::BodyInertia;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "kinetic-energy",
    TargetKind::Body,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "(m c'·c' + ω·I ω)/2",
        axes: "none: a number",
        sign: "never negative",
        contents: "Without rotors.",
    },
)
.without_rotation();

/// Mass properties of the measured body; `None` for the ground.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct BodyKineticEnergy<T: Real, const D: usize>(Option<BodyInertia<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for BodyKineticEnergy<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(of.index().map(|body| BodyInertia::new(from.scene, from.model, body)))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = self.0.as_ref().map_or(T::ZERO, |body| body.kinetic_energy(now.state));
    }
}
