//! Position of a material point.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, OutputPicture, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::natural::Affine;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "position",
    TargetKind::Point,
    ComponentForm::Vector("m"),
    QuantityDefinition {
        formula: "p",
        axes: "global",
        sign: "from the origin of the scene",
        contents: "The point goes with its body from where it is in the reference \
            configuration.",
    },
)
.drawn_as(OutputPicture::Trace);

/// Point whose position is measured.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Position<T: Real, const D: usize>(Affine<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Position<T, D> {
    type Of = Affine<T, D>;

    fn new(of: Affine<T, D>, _: &mut Maker<'_, T, D>) -> Self {
        Self(of)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(self.0.value(&now.state.q).as_slice());
    }
}
