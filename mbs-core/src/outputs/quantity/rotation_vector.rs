//! Rotation vector of a body.

use super::super::coordinate::Coordinate;
use super::kind::{Followed, Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rotation-vector",
    TargetKind::Body,
    ComponentForm::Axial("rad"),
    QuantityDefinition {
        formula: "φ n; in the plane φ",
        axes: "global, and the same in those of the body",
        sign: "right-handed",
        contents: "It grows continuously over whole turns. Its rate is the angular \
            velocity where the axis stays.",
    },
);

/// Rotation vector of the body, tracked from step to step; in a planar scene its angle.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RotationVector<T: Real, const D: usize>(Followed<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RotationVector<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(Followed::of_body(
            of,
            from,
            (|model| Coordinate::turn(model, [BodyId::Ground, of]), T::ZERO),
        ))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.write(now, out);
    }

    fn followed(&self) -> Option<&Followed<T, D>> {
        Some(&self.0)
    }
}
