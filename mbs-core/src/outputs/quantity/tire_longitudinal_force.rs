//! Longitudinal force of a tire, in the plane of the wheel.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "longitudinal-force",
    TargetKind::Effect,
    ComponentForm::Tire("N"),
    QuantityDefinition {
        formula: "-r load v_x/v_e + slip force",
        axes: "along t = b × n",
        sign: "positive along t: forward where the axis points to the left",
        contents: "Rolling resistance and the force by slip. Rolling resistance acts at \
            the hub, the force by slip at the radius below it.",
    },
)
.of_effects();

/// Index of the tire among the effects.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireLongitudinalForce<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireLongitudinalForce<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.tire(self.0, now.state).longitudinal);
    }
}
