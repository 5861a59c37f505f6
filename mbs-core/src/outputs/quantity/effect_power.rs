//! Power that an effect supplies to bodies.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "power",
    TargetKind::Effect,
    ComponentForm::Number("W"),
    QuantityDefinition {
        formula: "-f m'; on bodies F·v + M·ω; of a rotor -J q'' q'",
        axes: "none: a number",
        sign: "positive: bodies get it",
        contents: "What is stored is part of it: a spring gives as much as its energy \
            falls. v is that of the point against the ground, also where the road \
            moves.",
    },
)
.of_effects();

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectPower<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectPower<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.power(self.0, now.state));
    }
}
