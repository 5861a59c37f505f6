//! Camber of a wheel.

use super::kind::{Instant, Maker, Measured};
use super::wheel::CarrierDirection;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::WheelCarrier;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "camber",
    TargetKind::WheelCarrier,
    ComponentForm::Number("rad"),
    QuantityDefinition {
        formula: "asin R_zy",
        axes: "x forward, y inward, z up, of the vehicle body",
        sign: "positive: the top of the wheel leans outwards",
        contents: "The wheel's axis in the vehicle body: a spin about it changes nothing.",
    },
);

/// Axis of the measured wheel.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Camber<T: Real, const D: usize>(CarrierDirection<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Camber<T, D> {
    type Of = WheelCarrier<T>;

    fn new(of: WheelCarrier<T>, from: &mut Maker<'_, T, D>) -> Self {
        Self(CarrierDirection::new(&of, from, 1))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        // asin(R_zy) by an arc tangent, since R_zy may exceed one by a rounding error
        let [x, y, z] = self.0.parts(now.state);
        out[0] = z.atan2((x * x + y * y).sqrt());
    }
}
