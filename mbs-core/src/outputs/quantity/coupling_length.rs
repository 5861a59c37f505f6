//! Length of the lines of a coupling, such as a rope between its points.

use super::super::coupled_sum::CoupledSum;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "length",
    TargetKind::Coupling,
    ComponentForm::Length,
    QuantityDefinition {
        formula: "Σ |r_(i+1) - r_i|",
        axes: "none: a number",
        sign: "never negative",
        contents: "All lines of the coupling, over all their points. What a drum holds is \
            not in it.",
    },
);

/// Sum of the coupling, which contains the lines.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CouplingLength<T: Real, const D: usize>(CoupledSum<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for CouplingLength<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        Self(CoupledSum::new(from.scene, from.model, of.index()))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = self.0.length(now.state);
    }
}
