//! Angular velocity of a body as seen from another body.

use super::super::frame::Frame;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "angular-velocity",
    TargetKind::RelativeBody,
    ComponentForm::Axial("rad/s"),
    QuantityDefinition {
        formula: "R_o^T (ω - ω_o)",
        axes: "of `relative_to`",
        sign: "right-handed; in the plane counterclockwise",
        contents: "",
    },
);

/// Measured body, and the body to which it is relative.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RelativeAngularVelocity<T: Real, const D: usize>([Frame<T, D>; 2]);

impl<T: Real, const D: usize> Measured<T, D> for RelativeAngularVelocity<T, D> {
    type Of = [BodyId; 2];

    fn new(of: [BodyId; 2], from: &mut Maker<'_, T, D>) -> Self {
        Self(of.map(|body| Frame::new(from.model, body)))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let state = now.state;
        let [own, other] = self.0.each_ref().map(|frame| frame.turning(&state.q, &state.v));
        let spin = self.0[1].rotation(&state.q).transpose() * (own - other);
        // in a planar scene the component about z
        out.copy_from_slice(&spin.as_slice()[3 - out.len()..]);
    }
}
