//! Contact point of a tire.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "contact-point",
    TargetKind::Effect,
    ComponentForm::TirePoint,
    QuantityDefinition {
        formula: "c - (d/cos γ) e, e = (n - (u·n) u)/cos γ",
        axes: "global",
        sign: "from the origin of the scene",
        contents: "The lowest point of the disc, in its plane: c the centre, d its \
            distance from the road. Above the road the point below it on the road.",
    },
)
.of_effects();

/// Index of the tire among the effects.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct TireContactPoint<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for TireContactPoint<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let point = now.effects.map_or([T::ZERO; 3], |all| all.tire(self.0, now.state).contact);
        out.copy_from_slice(&point[..out.len()]);
    }
}
