//! Reaction of a joint.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("reaction", TargetKind::Joint, ComponentForm::Wrench).of_reactions();

/// The joint.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Reaction<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for Reaction<T, D> {
    type Of = JointId;

    fn new(joint: JointId, _: &mut Maker<'_, T, D>) -> Self {
        Self(joint.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let wrench = now.reactions.map_or([T::ZERO; 6], |all| all.reaction(self.0));
        out.copy_from_slice(&wrench[..out.len()]);
    }
}
