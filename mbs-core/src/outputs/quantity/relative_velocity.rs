//! Velocity of a material point as seen from another body.

use super::kind::{Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "velocity",
    TargetKind::RelativePoint,
    ComponentForm::Vector("m/s"),
    QuantityDefinition {
        formula: "R_o^T (r' - ω_o × r)",
        axes: "of `relative_to`",
        sign: "along the axes",
        contents: "The velocity that an observer on the other body sees.",
    },
);

/// Point whose velocity is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RelativeVelocity<T: Real, const D: usize>(SeenPoint<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RelativeVelocity<T, D> {
    type Of = SeenPoint<T, D>;

    fn new(of: SeenPoint<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.velocity(now.state, out);
    }
}
