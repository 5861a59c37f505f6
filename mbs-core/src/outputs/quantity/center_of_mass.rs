//! Centre of mass of all bodies.

use super::super::inertia::{self, BodyInertia};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "center-of-mass",
    TargetKind::Scene,
    ComponentForm::Vector("m"),
    QuantityDefinition {
        formula: "C = Σ m c/Σ m",
        axes: "global",
        sign: "from the origin of the scene",
        contents: "The origin where bodies have no mass.",
    },
);

/// Bodies of the scene, with their mass properties.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CenterOfMass<T: Real, const D: usize>(Vec<BodyInertia<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for CenterOfMass<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        Self(from.bodies())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(&inertia::center(&self.0, now.state)[0].as_slice()[..D]);
    }
}
