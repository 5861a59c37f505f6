//! Position of a material point as seen from another body.

use super::kind::{Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "position",
    TargetKind::RelativePoint,
    ComponentForm::Vector("m"),
    QuantityDefinition {
        formula: "R_o^T r, r = p - o",
        axes: "of `relative_to`",
        sign: "from `origin` to the point",
        contents: "",
    },
);

/// Point whose position is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RelativePosition<T: Real, const D: usize>(SeenPoint<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RelativePosition<T, D> {
    type Of = SeenPoint<T, D>;

    fn new(of: SeenPoint<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.position(now.state, out);
    }
}
