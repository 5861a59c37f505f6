//! The number that an effect measures.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "value",
    TargetKind::Effect,
    ComponentForm::Measured(""),
    QuantityDefinition {
        formula: "m",
        axes: "none: a number",
        sign: "a length, or the coordinate of the joint",
        contents: "Along a line its length over all points, with a `direction` the \
            distance along it; on a joint its coordinate; on a sum the sum. Turns \
            are counted.",
    },
)
.of_effects()
.or("length");

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectValue<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectValue<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.scalar(self.0, now.state).value);
    }
}
