//! Orientation of a body.

use super::super::coordinate::Coordinate;
use super::kind::{Followed, Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "orientation",
    TargetKind::Body,
    ComponentForm::Orientation,
    QuantityDefinition {
        formula: "(cos φ/2, n sin φ/2); in the plane φ",
        axes: "global",
        sign: "the sign of the quaternion follows from step to step; at first w is \
            positive",
        contents: "R is the turn by φ about n since the reference configuration. In the \
            plane turns are counted.",
    },
);

/// Angle or quaternion of the body, tracked from step to step.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Orientation<T: Real, const D: usize>(Followed<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Orientation<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(Followed::of_body(of, from, (|model| Coordinate::quaternion(model, of), T::ONE)))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.write(now, out);
    }

    fn followed(&self) -> Option<&Followed<T, D>> {
        Some(&self.0)
    }
}
