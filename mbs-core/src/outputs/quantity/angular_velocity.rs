//! Angular velocity of a body.

use super::super::frame::Frame;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "angular-velocity",
    TargetKind::Body,
    ComponentForm::Axial("rad/s"),
    QuantityDefinition {
        formula: "ω = 1/2 Σ u_k × u_k'",
        axes: "global",
        sign: "right-handed; in the plane counterclockwise",
        contents: "u_k: the three directions of the body. Of a thin rod that balls alone \
            hold the part across it.",
    },
);

/// Directions of the measured body. A thin rod between ball joints has no spin about its axis.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct AngularVelocity<T: Real, const D: usize>(Frame<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for AngularVelocity<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(Frame::new(from.model, of))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        // the angular velocity; in a planar scene the component about z
        let omega = self.0.turning(&now.state.q, &now.state.v);
        out.copy_from_slice(&omega.as_slice()[3 - out.len()..]);
    }
}
