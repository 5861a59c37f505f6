//! Slip angle of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("slip-angle", TargetKind::Effect, ComponentForm::Tire("rad")).of_effects();

/// The effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireSlipAngle<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireSlipAngle<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.tire(self.0, now.state).slip_angle);
    }
}
