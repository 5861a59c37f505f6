//! Accelerations of the coordinates of a joint.

use super::super::coordinate::Coordinate;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "acceleration",
    TargetKind::Joint,
    ComponentForm::Coordinates("/s^2"),
    QuantityDefinition {
        formula: "θ'', s''; of a ball ω_2' - ω_1'",
        axes: "of a ball global",
        sign: "as the coordinate",
        contents: "",
    },
);

/// Coordinates of the measured joint.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointAcceleration<T: Real, const D: usize>(Vec<Coordinate<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for JointAcceleration<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        Self(from.coordinates(joint))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let mut rest = out;
        for coordinate in &self.0 {
            let (here, tail) = rest.split_at_mut(coordinate.len());
            coordinate.accelerations(now.state, here);
            rest = tail;
        }
    }
}
