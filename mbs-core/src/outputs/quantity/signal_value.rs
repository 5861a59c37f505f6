//! Value of a signal of the scene.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::SignalId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "value",
    TargetKind::Signal,
    ComponentForm::Measured(""),
    QuantityDefinition {
        formula: "s",
        axes: "none: a number",
        sign: "as the signal is made",
        contents: "In the unit of what it measures or of its input, else `-`.",
    },
)
.of_effects();

/// Index of the measured signal.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct SignalValue<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for SignalValue<T, D> {
    type Of = SignalId;

    fn new(of: SignalId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.effects.map_or(T::ZERO, |all| all.signal(self.0)[0]);
    }
}
