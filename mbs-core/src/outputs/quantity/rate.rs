//! Rates of the coordinates of a joint.

use super::super::coordinate::Coordinate;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rate",
    TargetKind::Joint,
    ComponentForm::Coordinates("/s"),
    QuantityDefinition {
        formula: "θ', s'; of a ball ω_2 - ω_1",
        axes: "of a ball global",
        sign: "as the coordinate",
        contents: "Of a ball it is the difference of angular velocities, and not the rate \
            of the rotation vector.",
    },
);

/// Coordinates of the measured joint.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointRate<T: Real, const D: usize>(Vec<Coordinate<T, D>>);

impl<T: Real, const D: usize> Measured<T, D> for JointRate<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        Self(from.coordinates(joint))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let mut rest = out;
        for coordinate in &self.0 {
            let (here, tail) = rest.split_at_mut(coordinate.len());
            coordinate.rates(&now.state.q, &now.state.v, here);
            rest = tail;
        }
    }
}
