//! How the numbers of a quantity are read.

use super::super::coordinate::Coordinate;
use super::super::reaction::Reactions;
use crate::Real;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::scene::{JointId, Scene};
use alloc::vec::Vec;

/// What a quantity is read with.
pub(super) trait Measured<T: Real, const D: usize> {
    /// The point, the body or the joint.
    type Of;

    /// Prepares it.
    fn new(of: Self::Of, from: &mut Maker<'_, T, D>) -> Self;

    /// Writes its components at an instant. Cost: a few products, no allocation.
    fn write(&self, now: &Instant<'_, T, D>, out: &mut [T]);
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
        Coordinate::of_joint(self.scene, self.model, &self.scene.joints[joint])
    }
}

/// What quantities are read of.
pub(in crate::outputs) struct Instant<'a, T: Real, const D: usize> {
    pub state: &'a State<T>,
    /// The present values of coordinates that are followed.
    pub values: &'a [T],
    /// Those of the state; zero where there are none.
    pub reactions: Option<&'a Reactions<T, D>>,
}
