//! Side force of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "side-force",
    TargetKind::Effect,
    ComponentForm::Tire("N"),
    QuantityDefinition {
        formula: "F_y(load, α, γ)",
        axes: "along b",
        sign: "positive along the axis u; at a positive slip angle it is negative",
        contents: "b: u without its part along n. By slip angle and camber, less what \
            sliding lengthways takes.",
    },
)
.of_effects();

/// Index of the tire among the effects.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireSideForce<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireSideForce<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.tire(self.0, now.state).side);
    }
}
