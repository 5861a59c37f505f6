//! Power that a guide supplies through a joint.

use super::super::coordinate::Coordinate;
use super::joint_effort::JointEffort;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "power",
    TargetKind::Joint,
    ComponentForm::Number("W"),
    QuantityDefinition {
        formula: "Σ effort · rate",
        axes: "none: a number",
        sign: "positive: the guide gives",
        contents: "Effects on the joint are not in it.",
    },
)
.of_reactions();

/// Largest number of coordinates of a joint [-]: three slides and three components of a rotation.
const MOST_COORDINATES: usize = 6;

/// Effort of the guide on the coordinates of the joint.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointPower<T: Real, const D: usize>(JointEffort<T, D>);

impl<T: Real, const D: usize> Measured<T, D> for JointPower<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        Self(JointEffort::new(joint, from))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let (mut efforts, mut rates) = ([T::ZERO; MOST_COORDINATES], [T::ZERO; MOST_COORDINATES]);
        let n: usize = self.0.coordinates().iter().map(Coordinate::len).sum();
        self.0.write(now, &mut efforts[..n]);
        let mut rest = &mut rates[..n];
        for coordinate in self.0.coordinates() {
            let (here, tail) = rest.split_at_mut(coordinate.len());
            coordinate.rates(&now.state.q, &now.state.v, here);
            rest = tail;
        }
        out[0] = efforts.iter().zip(&rates).fold(T::ZERO, |sum, (f, v)| sum + *f * *v);
    }
}
