//! What a quantity says of itself, what it is of, and how its numbers are read.

use super::super::coordinate::Coordinate;
use super::super::reaction::Reactions;
use super::components::ComponentForm;
use crate::Real;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::scene::{BodyId, JointId, Scene};
use alloc::vec::Vec;

/// What a quantity is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<T> {
    /// The material point of a body that is at this place in the reference configuration [m].
    Point(BodyId, [T; 3]),
    /// A body.
    Body(BodyId),
    /// A joint.
    Joint(JointId),
}

/// What a kind of quantity is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TargetKind {
    /// A material point of a body.
    Point,
    /// A body.
    Body,
    /// A joint.
    Joint,
}

impl TargetKind {
    /// Its keys in scene files; the first one names the owner.
    #[must_use]
    pub const fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Point => &["body", "at"],
            Self::Body => &["body"],
            Self::Joint => &["joint"],
        }
    }
}

/// A kind of quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct QuantityRow {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it is of.
    pub target: TargetKind,
    /// Its components.
    pub components: ComponentForm,
    /// Is it read of reactions, which are not unique everywhere?
    pub needs_reactions: bool,
}

impl QuantityRow {
    /// The row of a quantity that is read of the state alone.
    pub(super) const fn new(
        name: &'static str,
        target: TargetKind,
        components: ComponentForm,
    ) -> Self {
        Self { name, target, components, needs_reactions: false }
    }
}

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
