//! Acceleration of a material point as seen from another body.

use super::kind::{Instant, Maker, Measured};
use super::seen::SeenPoint;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "acceleration",
    TargetKind::RelativePoint,
    ComponentForm::Vector("m/s^2"),
    QuantityDefinition {
        formula: "R_o^T (r'' - ω_o' × r - ω_o × (ω_o × r) - 2 ω_o × (r' - ω_o × r))",
        axes: "of `relative_to`",
        sign: "along the axes",
        contents: "The acceleration that an observer on the other body sees: without what \
            carries and without Coriolis.",
    },
);

/// Point whose acceleration is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RelativeAcceleration<T: Real, const D: usize>(SeenPoint<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RelativeAcceleration<T, D> {
    type Of = SeenPoint<T, D>;

    fn new(of: SeenPoint<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.acceleration(now.state, out);
    }
}
