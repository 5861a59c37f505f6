//! Effort of a coupling.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("effort", TargetKind::Coupling, ComponentForm::Force)
        .of_reactions()
        .or("force");

/// The coupling, and its effort over its multiplier.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Effort<T: Real, const D: usize>(usize, T);

impl<T: Real, const D: usize> Measured<T, D> for Effort<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, from: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), from.scene.couplings[of.index()].effort_factor())
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.reactions.map_or(T::ZERO, |all| all.effort(self.0) * self.1);
    }
}
