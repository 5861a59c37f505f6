//! Angular momentum of all bodies about their centre of mass.

use super::super::inertia::{self, BodyInertia};
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "angular-momentum",
    TargetKind::Scene,
    ComponentForm::Axial("kg m^2/s"),
    QuantityDefinition {
        formula: "Σ (I ω + m (c - C) × (c' - C'))",
        axes: "global",
        sign: "right-handed; in the plane counterclockwise",
        contents: "About the centre of mass of all. Without rotors.",
    },
);

/// Bodies of the scene, with their mass properties.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct AngularMomentum<T: Real, const D: usize>(Vec<BodyInertia<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for AngularMomentum<T, D> {
    type Of = ();

    fn new((): (), from: &mut Maker<'_, T, D>) -> Self {
        Self(from.bodies())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let sum = inertia::angular_momentum(&self.0, now.state);
        // in a planar scene the component about z
        out.copy_from_slice(&sum.as_slice()[3 - out.len()..]);
    }
}
