//! Effort of a guide on the coordinates of a joint.

use super::super::coordinate::Coordinate;
use super::super::wrench::Wrench;
use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::algebra::Vector;
use crate::scene::JointId;
use alloc::vec::Vec;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "effort",
    TargetKind::Joint,
    ComponentForm::Efforts,
    QuantityDefinition {
        formula: "M·a, F·d; of a ball M",
        axes: "of a ball global",
        sign: "of the first body on the second, positive along growth of the \
            coordinate",
        contents: "F, M: the `reaction`; a: the axis of the coordinate; d: the slide. \
            What a guide gives, zero of coordinates without one. Effects on the \
            joint are not in it.",
    },
)
.of_reactions();

/// Index of the joint, and its coordinates.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct JointEffort<T: Real, const D: usize>(usize, Vec<Coordinate<T, D>>);

impl<T: Real, const D: usize> JointEffort<T, D> {
    /// Coordinates of the measured joint.
    pub(super) fn coordinates(&self) -> &[Coordinate<T, D>] {
        &self.1
    }
}

impl<T: Real, const D: usize> Measured<T, D> for JointEffort<T, D> {
    type Of = JointId;

    fn new(joint: JointId, from: &mut Maker<'_, T, D>) -> Self {
        Self(joint.index(), from.coordinates(joint))
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let r = now.reactions.map_or([T::ZERO; 6], |all| all.reaction(self.0));
        let [force, moment] = match D {
            2 => [[r[0], r[1], T::ZERO], [T::ZERO, T::ZERO, r[2]]],
            _ => [[r[0], r[1], r[2]], [r[3], r[4], r[5]]],
        };
        let wrench = Wrench { force: Vector::from(force), moment: Vector::from(moment) };
        let mut rest = out;
        for coordinate in &self.1 {
            let (here, tail) = rest.split_at_mut(coordinate.len());
            coordinate.efforts(&now.state.q, &wrench, here);
            rest = tail;
        }
    }
}
