//! Caster of a wheel.

use super::kind::{Instant, Maker, Measured};
use super::wheel::CarrierDirection;
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::WheelCarrier;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "caster",
    TargetKind::WheelCarrier,
    ComponentForm::Number("rad"),
    QuantityDefinition {
        formula: "atan2(-R_xz, R_zz)",
        axes: "x forward, y inward, z up, of the vehicle body",
        sign: "positive: the top of the steering axis leans backwards",
        contents: "The steering axis in the vehicle body, as seen from the side.",
    },
);

/// Steering axis of the measured wheel.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Caster<T: Real, const D: usize>(CarrierDirection<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for Caster<T, D> {
    type Of = WheelCarrier<T>;

    fn new(of: WheelCarrier<T>, from: &mut Maker<'_, T, D>) -> Self {
        Self(CarrierDirection::new(&of, from, 2))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        // atan2(-R_xz, R_zz)
        let [x, _, z] = self.0.parts(now.state);
        out[0] = (-x).atan2(z);
    }
}
