//! Power of a driven coupling.

use super::super::coupled_sum::CoupledSum;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("power", TargetKind::Coupling, ComponentForm::Number("W")).of_reactions();

/// The coupling; with its sum, where that is driven.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CouplingPower<T: Real, const D: usize>(
    usize,
    Option<CoupledSum<T, D>>,
);

impl<T: Real, const D: usize> Measured<T, D> for CouplingPower<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        let index = of.index();
        let is_driven = from.scene.couplings[index].is_driven();
        Self(index, is_driven.then(|| CoupledSum::new(from.scene, from.model, index)))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let rate = self.1.as_ref().map_or(T::ZERO, |sum| sum.measure(now.state)[1]);
        out[0] = now.reactions.map_or(T::ZERO, |all| all.effort(self.0)) * rate;
    }
}
