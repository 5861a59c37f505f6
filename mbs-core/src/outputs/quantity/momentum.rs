//! Momentum of all bodies.

use super::super::inertia::{self, BodyInertia};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "momentum",
    TargetKind::Scene,
    ComponentForm::Vector("kg m/s"),
    QuantityDefinition {
        formula: "Σ m c'",
        axes: "global",
        sign: "along the axes",
        contents: "Rotors have none.",
    },
);

/// Bodies of the scene, with their mass properties.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Momentum<T: Real, const D: usize>(Vec<BodyInertia<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for Momentum<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        Self(from.bodies())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(&inertia::momentum(&self.0, now.state).as_slice()[..D]);
    }
}
