//! Angular acceleration of a body.

use super::super::frame::Frame;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "angular-acceleration",
    TargetKind::Body,
    ComponentForm::Axial("rad/s^2"),
    QuantityDefinition {
        formula: "ω'",
        axes: "global",
        sign: "right-handed; in the plane counterclockwise",
        contents: "Of a thin rod that balls alone hold the part across it.",
    },
);

/// Directions of the measured body.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct AngularAcceleration<T: Real, const D: usize>(Frame<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for AngularAcceleration<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(Frame::new(from.model, of))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let alpha = self.0.turning(&now.state.q, &now.state.a);
        out.copy_from_slice(&alpha.as_slice()[3 - out.len()..]);
    }
}
