//! Flag that is true if a one-sided effect is in contact.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "contact",
    TargetKind::Effect,
    ComponentForm::Contact,
    QuantityDefinition {
        formula: "1 where a gap is below zero, else 0",
        axes: "none: a number",
        sign: "none",
        contents: "Of bumpers, limits and tires, and of lines that only pull, where they \
            are taut.",
    },
)
.of_effects();

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectContact<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectContact<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let depth = now.effects.map_or(T::ZERO, |all| all.depth(self.0, now.state));
        out[0] = if depth > T::ZERO { T::ONE } else { T::ZERO };
    }
}
