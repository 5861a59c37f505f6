//! Contact force on a rolling body.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::RollingId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "force",
    TargetKind::Rolling,
    ComponentForm::Vector("N"),
    QuantityDefinition {
        formula: "from the balance of each body, as `reaction`",
        axes: "global",
        sign: "of the ground, or of the other body, on what rolls",
        contents: "At the lowest point, of a blade at its point: normal force and what \
            hinders slip. Of dependent ones the smallest.",
    },
)
.of_reactions();

/// Index of the rolling contact.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RollingForce<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for RollingForce<T, D> {
    type Of = RollingId;

    fn new(rolling: RollingId, _: &mut Maker<'_, T, D>) -> Self {
        Self(rolling.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let force = now.reactions.map_or([T::ZERO; 3], |all| all.rolling_force(self.0));
        out.copy_from_slice(&force[..out.len()]);
    }
}
