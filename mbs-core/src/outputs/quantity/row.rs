//! What a quantity says of itself, and what it is of.

use super::components::ComponentForm;
use crate::scene::{BodyId, JointId};

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
