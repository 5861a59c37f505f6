//! Error of the energy invariant, which a run records from step to step.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "invariant-error",
    TargetKind::Scene,
    ComponentForm::Number("J"),
    QuantityDefinition {
        formula: "Π(t) - Π(0), Π = T + V - W",
        axes: "none: a number",
        sign: "positive: energy has come from nowhere",
        contents: "W: what dampers, motors, guides and inputs gave. Zero without a run.",
    },
)
.of_the_run();

/// Channel without data: the run sets the error in the measures.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct InvariantError<T: Real, const D: usize>(PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for InvariantError<T, D> {
    type Of = ();

    fn new((): (), _: &mut Maker<'_, T, D>) -> Self {
        Self(PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.invariant_error;
    }
}
