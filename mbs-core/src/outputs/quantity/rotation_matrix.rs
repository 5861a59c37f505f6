//! Rotation matrix of a body.

use super::super::frame::Frame;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "rotation-matrix",
    TargetKind::Body,
    ComponentForm::Matrix,
    QuantityDefinition {
        formula: "R_ij = e_i · u_j",
        axes: "global",
        sign: "the columns are the present directions of the axes of the reference \
            configuration",
        contents: "Row by row.",
    },
);

/// Frame of the measured body.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RotationMatrix<T: Real, const D: usize>(Frame<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RotationMatrix<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        Self(Frame::new(from.model, of))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let r = self.0.rotation(&now.state.q);
        for (i, out) in out.iter_mut().enumerate() {
            *out = r[(i / D, i % D)];
        }
    }
}
