//! Common interface of the quantities: how their values are computed from a state.

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

/// Quantity that is prepared once and then evaluated at many states.
pub(super) trait Measured<T: Real, const D: usize> {
    /// Target of the quantity: a point, body, joint, coupling or effect; empty for the whole scene.
    type Of;

    /// Prepares the quantity of a target.
    fn new(of: Self::Of, from: &mut Maker<'_, T, D>) -> Self;

    /// Writes the components at one instant. Cost: a few products, no allocation.
    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]);

    /// Coordinates that the quantity tracks from step to step.
    fn followed(&self) -> Option<&Followed<T, D>> {
        None
    }
}

/// Coordinates that are tracked from step to step.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct Followed<T: Real, const D: usize> {
    pub coordinates: Vec<Coordinate<T, D>>,
    /// Index of their first value among the values of all tracked coordinates.
    pub start: usize,
    /// Index of the joint with these coordinates; `None`: a body relative to the ground.
    pub joint: Option<usize>,
}

impl<T: Real, const D: usize> Followed<T, D> {
    /// Rotation of a body relative to the ground: an angle in a planar scene, the coordinate `spatial` in a spatial one. `first` is the
    /// start value of its first component.
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

    /// Writes the present values of the coordinates.
    pub(super) fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]) {
        out.copy_from_slice(&now.values[self.start..][..out.len()]);
    }
}

/// Data from which quantities are prepared.
pub(in crate::outputs) struct Maker<'a, T: Real, const D: usize> {
    pub scene: &'a Scene<T>,
    pub model: &'a NaturalModel<T, D>,
    /// Coordinates of each joint at time zero.
    pub starts: &'a [Vec<T>],
    /// Start values of tracked coordinates.
    pub values: Vec<T>,
}

impl<T: Real, const D: usize> Maker<'_, T, D> {
    /// Coordinates of a joint in the order of their numbers.
    pub(super) fn coordinates(&self, joint: JointId) -> Vec<Coordinate<T, D>> {
        Coordinate::of_joint(self.scene, self.model, &self.scene.joints[joint.index()])
    }

    /// All bodies with their mass properties.
    pub(super) fn bodies(&self) -> Vec<BodyInertia<T, D>> {
        let of = |body| BodyInertia::new(self.scene, self.model, body);
        (0..self.scene.bodies.len()).map(of).collect()
    }

    /// All rotors of the scene.
    pub(super) fn rotors(&self) -> Vec<RotorTorque<T, D>> {
        RotorTorque::all(self.scene, self.model)
    }
}

/// Data from which quantities are evaluated at one instant.
pub(in crate::outputs) struct Instant<'a, T: Real, const D: usize> {
    pub state: &'a State<T>,
    /// Present values of tracked coordinates.
    pub values: &'a [T],
    /// Reactions at the state. `None`: quantities that need reactions are zero.
    pub reactions: Option<&'a Reactions<T, D>>,
    pub effects: Option<&'a EffectWrenches<T, D>>,
    /// Error of the energy invariant of the run [J].
    pub invariant_error: T,
}
