//! How the numbers of a quantity are read.

use super::super::coordinate::Coordinate;
use super::super::exerted::EffectWrenches;
use super::super::inertia::BodyInertia;
use super::super::reaction::Reactions;
use super::super::rotor::RotorTorque;
use crate::Real;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::scene::{BodyId, JointId};
use alloc::vec;
use alloc::vec::Vec;

/// What a quantity is read with.
pub(super) trait Measured<T: Real, const D: usize> {
    /// The point, the body, the joint, the coupling or the effect; nothing of the whole scene.
    type Of;

    /// Prepares it.
    fn new(of: Self::Of, from: &mut Maker<'_, T, D>) -> Self;

    /// Writes its components at an instant. Cost: a few products, no allocation.
    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]);

    /// The coordinates that it follows from step to step.
    fn followed(&self) -> Option<&Followed<T, D>> {
        None
    }
}

/// Coordinates that are followed from step to step.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Followed<T: Real, const D: usize> {
    pub coordinates: Vec<Coordinate<T, D>>,
    /// Where their values start among those of all that are followed.
    pub start: usize,
    /// The joint that they are of; `None`: a body against the ground.
    pub joint: Option<usize>,
}

impl<T: Real, const D: usize> Followed<T, D> {
    /// The rotation of a body against the ground from these first numbers on: its angle in the plane, in space what `spatial` makes.
    pub(super) fn of_body(
        body: BodyId,
        from: &mut Maker<'_, T, D>,
        (spatial, first): (impl FnOnce(&NaturalModel<T, D>) -> Coordinate<T, D>, T),
    ) -> Self {
        let start = from.values.len();
        let (coordinate, first) = if D == 2 {
            (Coordinate::between(from.model, [BodyId::Ground, body]), T::ZERO)
        } else {
            (spatial(from.model), first)
        };
        from.values.push(first);
        from.values.resize(start + coordinate.len(), T::ZERO);
        Self { coordinates: vec![coordinate], start, joint: None }
    }

    /// Writes their present values.
    pub(super) fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(&now.values[self.start..][..out.len()]);
    }
}

/// What quantities are made of.
pub(in crate::outputs) struct Maker<'a, T: Real, const D: usize> {
    pub scene: &'a Scene<T>,
    pub model: &'a NaturalModel<T, D>,
    /// Coordinates of each joint at time zero.
    pub starts: &'a [Vec<T>],
    /// The first values of coordinates that are followed.
    pub values: Vec<T>,
}

impl<T: Real, const D: usize> Maker<'_, T, D> {
    /// The coordinates of a joint, in the order of its numbers.
    pub(super) fn coordinates(&self, joint: JointId) -> Vec<Coordinate<T, D>> {
        Coordinate::of_joint(self.scene, self.model, &self.scene.joints[joint.index()])
    }

    /// All bodies with their masses.
    pub(super) fn bodies(&self) -> Vec<BodyInertia<T, D>> {
        let of = |body| BodyInertia::new(self.scene, self.model, body);
        (0..self.scene.bodies.len()).map(of).collect()
    }

    /// All rotors.
    pub(super) fn rotors(&self) -> Vec<RotorTorque<T, D>> {
        RotorTorque::all(self.scene, self.model)
    }
}

/// What quantities are read of.
pub(in crate::outputs) struct Instant<'a, T: Real, const D: usize> {
    pub state: &'a State<T>,
    /// The present values of coordinates that are followed.
    pub values: &'a [T],
    /// Those of the state; zero where there are none.
    pub reactions: Option<&'a Reactions<T, D>>,
    pub effects: Option<&'a EffectWrenches<T, D>>,
    /// Error of the energy invariant of the run [J].
    pub invariant_error: T,
}
