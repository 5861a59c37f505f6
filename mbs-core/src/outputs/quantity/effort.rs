//! Effort of a coupling.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::CouplingId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("effort", TargetKind::Coupling, ComponentForm::Force)
        .of_reactions()
        .or("force");

/// The coupling.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Effort<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for Effort<T, D> {
    type Of = CouplingId;

    fn new(of: CouplingId, _: &mut Maker<'_, T, D>) -> Self {
        Self(of.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = now.reactions.map_or(T::ZERO, |all| all.effort(self.0));
    }
}
