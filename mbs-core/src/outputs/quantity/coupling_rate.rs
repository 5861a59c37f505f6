//! Rate of the sum of a coupling.

use super::super::coupled_sum::CoupledSum;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rate",
    TargetKind::Coupling,
    ComponentForm::Measured("/s"),
    QuantityDefinition {
        formula: "Σ c_k f_k' m_k'",
        axes: "none: a number",
        sign: "as the sum",
        contents: "",
    },
);

/// Sum of the measured coupling.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CouplingRate<T: Real, const D: usize>(CoupledSum<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for CouplingRate<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        Self(CoupledSum::new(from.scene, from.model, of.index()))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = self.0.measure(now.state)[1];
    }
}
