//! Toe of a wheel.

use super::kind::{Instant, Maker, Measured};
use super::wheel::CarrierDirection;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::WheelCarrier;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "toe",
    TargetKind::WheelCarrier,
    ComponentForm::Number("rad"),
    QuantityDefinition {
        formula: "atan2(-R_xy, R_yy)",
        axes: "x forward, y inward, z up, of the vehicle body",
        sign: "positive: the front of the wheel points inwards",
        contents: "The steering angle is part of it: to the left it is -toe of a left \
            wheel, toe of a right one.",
    },
);

/// Axis of the measured wheel.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Toe<T: Real, const D: usize>(CarrierDirection<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Toe<T, D> {
    type Of = WheelCarrier<T>;

    fn new(of: WheelCarrier<T>, from: &mut Maker<'_, T, D>) -> Self {
        Self(CarrierDirection::new(&of, from, 1))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        // atan2(-R_xy, R_yy)
        let [x, y, _] = self.0.parts(now.state);
        out[0] = (-x).atan2(y);
    }
}
