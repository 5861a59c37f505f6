//! Coordinates of a joint, which count turns.

use super::super::coordinate::Coordinate;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("value", TargetKind::Joint, ComponentForm::Coordinates(""));

/// Its coordinates, which are followed from step to step.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointValue<T: Real, const D: usize> {
    pub coordinates: Vec<Coordinate<T, D>>,
    /// Where their values start among those of all that are followed.
    pub start: usize,
    pub joint: usize,
}

impl<T: Real, const D: usize> Measured<T, D> for JointValue<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        let (start, index) = (from.values.len(), joint.index());
        from.values.extend_from_slice(&from.starts[index]);
        Self { coordinates: from.coordinates(joint), start, joint: index }
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(&now.values[self.start..][..out.len()]);
    }
}
