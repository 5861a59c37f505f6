//! Proper acceleration of a material point: the reading of an accelerometer, in global axes.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::algebra::{Vector, raised};
use crate::natural::Affine;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "proper-acceleration",
    TargetKind::Point,
    ComponentForm::Vector("m/s^2"),
    QuantityDefinition {
        formula: "p'' - g",
        axes: "global",
        sign: "along the axes",
        contents: "The reading of an accelerometer: at rest it points upwards, with the \
            size of gravity.",
    },
);

/// Point whose acceleration is measured, and gravity [m/s^2].
#[derive(Debug, Clone)]
pub(in crate::outputs) struct ProperAcceleration<T: Real, const D: usize>(
    Affine<T, D>,
    Vector<T, 3>,
);

impl<T: Real, const D: usize> Measured<T, D> for ProperAcceleration<T, D> {
    type Of = Affine<T, D>;

    fn new(of: Affine<T, D>, from: &mut Maker<'_, T, D>) -> Self {
        Self(of, from.scene.gravity.map_or_else(Vector::zeros, Vector::from))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        // acceleration minus gravity
        let proper = raised(&self.0.rate(&now.state.a)) - self.1;
        out.copy_from_slice(&proper.as_slice()[..out.len()]);
    }
}
