//! Distance of a material point from a point of another body.

use super::kind::{Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "distance",
    TargetKind::RelativePoint,
    ComponentForm::Number("m"),
    QuantityDefinition {
        formula: "|p - o|",
        axes: "none: a number",
        sign: "never negative",
        contents: "",
    },
)
.without_rotation();

/// Point whose distance is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Distance<T: Real, const D: usize>(SeenPoint<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Distance<T, D> {
    type Of = SeenPoint<T, D>;

    fn new(of: SeenPoint<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out[0] = self.0.distance(now.state);
    }
}
