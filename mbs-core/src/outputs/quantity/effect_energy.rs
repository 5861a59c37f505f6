//! Energy stored in an effect.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "energy",
    TargetKind::Effect,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "V(m); of a constant force -F·r; of a rotor J q'^2/2",
        axes: "none: a number",
        sign: "as its potential",
        contents: "What springs store, those of stops and tires among them. Dampers, \
            friction, and forces that follow time or inputs have none.",
    },
)
.of_effects();

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectEnergy<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectEnergy<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.energy(Some(self.0), now.state));
    }
}
