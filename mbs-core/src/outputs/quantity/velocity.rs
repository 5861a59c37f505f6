//! Velocity of a material point.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::natural::Affine;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "velocity",
    TargetKind::Point,
    ComponentForm::Vector("m/s"),
    QuantityDefinition { formula: "p'", axes: "global", sign: "along the axes", contents: "" },
);

/// Point whose velocity is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Velocity<T: Real, const D: usize>(Affine<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Velocity<T, D> {
    type Of = Affine<T, D>;

    fn new(of: Affine<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(self.0.rate(&now.state.v).as_slice());
    }
}
