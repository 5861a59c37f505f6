//! Coordinates of a joint, whole turns included.

use super::kind::{Followed, Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "value",
    TargetKind::Joint,
    ComponentForm::Coordinates(""),
    QuantityDefinition {
        formula: "θ, s; of a ball φ n",
        axes: "of a ball those of the first body",
        sign: "the second body against the first, right-handed about the axis, \
            positive along it",
        contents: "Slides come before turns. Turns are counted, from `[[initial]]`, a \
            guide or zero.",
    },
);

/// Coordinates of the joint, tracked from step to step.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointValue<T: Real, const D: usize>(Followed<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for JointValue<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        let (start, index) = (from.values.len(), joint.index());
        from.values.extend_from_slice(&from.starts[index]);
        Self(Followed { coordinates: from.coordinates(joint), start, joint: Some(index) })
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.write(now, out);
    }

    fn followed(&self) -> Option<&Followed<T, D>> {
        Some(&self.0)
    }
}
