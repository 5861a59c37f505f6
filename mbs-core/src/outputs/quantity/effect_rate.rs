//! Rate of the number that an effect measures.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rate",
    TargetKind::Effect,
    ComponentForm::Measured("/s"),
    QuantityDefinition {
        formula: "m'",
        axes: "none: a number",
        sign: "as the value",
        contents: "Zero at length zero.",
    },
)
.of_effects();

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectRate<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectRate<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.scalar(self.0, now.state).rate);
    }
}
