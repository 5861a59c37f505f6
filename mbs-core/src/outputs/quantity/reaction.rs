//! Reaction of a joint.

use super::kind::{Instant, Maker, Measured};
use super::{ComponentForm, OutputPicture, QuantityDefinition, QuantityRow, TargetKind};
use crate::Real;
use crate::scene::JointId;
use core::marker::PhantomData;

pub(super) const ROW: QuantityRow = QuantityRow::new(
    "reaction",
    TargetKind::Joint,
    ComponentForm::Wrench,
    QuantityDefinition {
        formula: "Σ ±(F, M) + applied = (m (c'' - g), I ω' + ω × I ω) of each body",
        axes: "global",
        sign: "of the first body on the second",
        contents: "At the joint's place on the second body. In it: what the joint \
            transmits, and what its guide gives. Forces of teeth, of a thread and \
            of a rope at its drum are in it where it carries them. The scene must \
            give their place. Not in it: effects on the joint itself, which act \
            beside it (spring, friction, motor, limit, rotor), and the torque of a \
            coupling. Where loops leave it open it is the smallest one, and \
            marked.",
    },
)
.of_reactions()
.without_rotation()
.drawn_as(OutputPicture::Force);

/// Index of the measured joint.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Reaction<T: Real, const D: usize>(usize, PhantomData<T>);

impl<T: Real, const D: usize> Measured<T, D> for Reaction<T, D> {
    type Of = JointId;

    fn new(joint: JointId, _: &mut Maker<'_, T, D>) -> Self {
        Self(joint.index(), PhantomData)
    }

    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        let wrench = now.reactions.map_or([T::ZERO; 6], |all| all.reaction(self.0));
        out.copy_from_slice(&wrench[..out.len()]);
    }
}
