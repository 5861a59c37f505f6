//! Rotation vector of a body.

use super::super::coordinate::Coordinate;
use super::kind::{Followed, Instant, Maker, Measured};
use super::{ComponentForm, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::BodyId;
use alloc::vec;

pub(super) const ROW: QuantityRow =
    QuantityRow::new("rotation-vector", TargetKind::Body, ComponentForm::Axial("rad"));

/// The vector, which is followed from step to step; in the plane the angle.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct RotationVector<T: Real, const D: usize>(Followed<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for RotationVector<T, D> {
    type Of = BodyId;

    fn new(of: BodyId, from: &mut Maker<'_, T, D>) -> Self {
        let start = from.values.len();
        let coordinate = if D == 2 {
            Coordinate::between(from.model, [BodyId::Ground, of])
        } else {
            Coordinate::turn(from.model, [BodyId::Ground, of])
        };
        from.values.resize(start + coordinate.len(), T::ZERO);
        Self(Followed { coordinates: vec![coordinate], start, joint: None })
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        self.0.write(now, out);
    }

    fn followed(&self) -> Option<&Followed<T, D>> {
        Some(&self.0)
    }
}
