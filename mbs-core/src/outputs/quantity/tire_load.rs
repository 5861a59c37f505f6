//! Normal load of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "load",
    TargetKind::Effect,
    ComponentForm::Tire("N"),
    QuantityDefinition {
        formula: "F/cos γ, F = k x + c x', not negative",
        axes: "along n",
        sign: "positive: the road pushes the tire",
        contents: "n: the road's normal. x = R - d/cos γ: how far the tire is pressed in. \
            The damper fades in over 1 mm.",
    },
)
.of_effects();

/// Index of the tire among the effects.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireLoad<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireLoad<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.tire(self.0, now.state).load);
    }
}
