//! Slip angle of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "slip-angle",
    TargetKind::Effect,
    ComponentForm::Tire("rad"),
    QuantityDefinition {
        formula: "α = atan(v_y/v_e), v_e = √(v_x^2 + (0.1 m/s)^2)",
        axes: "v_x along t at the hub, v_y along b at the contact point",
        sign: "positive: the contact point slides along the axis u",
        contents: "Zero above the road, and of a tire without a side force.",
    },
)
.of_effects();

/// Index of the tire among the effects.
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
