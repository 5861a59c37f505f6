//! Rate of a signal of the scene.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::SignalId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rate",
    TargetKind::Signal,
    ComponentForm::Measured("/s"),
    QuantityDefinition {
        formula: "s'",
        axes: "none: a number",
        sign: "as the signal",
        contents: "Zero of a measured rate and of what a controller asks for.",
    },
)
.of_effects();

/// Index of the measured signal.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct SignalRate<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for SignalRate<T, D> {
    type Of = SignalId;

    fn new(of: SignalId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.signal(self.0)[1]);
    }
}
