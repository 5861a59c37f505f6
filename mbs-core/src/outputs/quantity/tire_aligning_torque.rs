//! Aligning torque of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "aligning-torque",
    TargetKind::Effect,
    ComponentForm::Tire("N m"),
    QuantityDefinition {
        formula: "M_z v_x/v_e",
        axes: "about n",
        sign: "right-handed about n; at small slip it turns a wheel that rolls \
            forward towards its motion",
        contents: "The moment of the side force about the hub is not in it.",
    },
)
.of_effects();

/// Index of the tire among the effects.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireAligningTorque<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireAligningTorque<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.tire(self.0, now.state).aligning);
    }
}
