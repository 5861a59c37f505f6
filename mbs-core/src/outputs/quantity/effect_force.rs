//! Force of an effect.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, OutputPicture, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::EffectId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "force",
    TargetKind::Effect,
    ComponentForm::Force,
    QuantityDefinition {
        formula: "f; on bodies (F, M)",
        axes: "of (F, M) global",
        sign: "along a length positive: it pulls the ends together; on a joint and a \
            sum positive against growth; (F, M) on the body, of two on the second",
        contents: "One number where the effect measures one: the whole tension of its \
            law, dampers included. An `actuator` or `torque` of positive value has \
            a negative f. On bodies (force, torque, drag, tire, bushing): about \
            the point of the effect on that body, as it has moved.",
    },
)
.of_effects()
.drawn_as(OutputPicture::Force);

/// Index of the measured effect.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct EffectForce<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for EffectForce<T, D> {
    type Of = EffectId;

    fn new(of: EffectId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let Some(all) = now.effects else { return out.fill(T::ZERO) };
        if let [one] = out {
            *one = all.scalar(self.0, now.state).tension;
        } else {
            let sum = all.wrench(self.0, now.state);
            out[..D].copy_from_slice(&sum.force.as_slice()[..D]);
            // in a planar scene the component about z
            let n = out.len() - D;
            out[D..].copy_from_slice(&sum.moment.as_slice()[3 - n..]);
        }
    }
}
