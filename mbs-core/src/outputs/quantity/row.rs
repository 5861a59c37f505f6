//! What a quantity says of itself, and what it is of.

use super::components::ComponentForm;
use crate::scene::{BodyId, CouplingId, EffectId, JointId, SignalId};

/// What a quantity is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<T> {
    /// The material point of a body that is at this place in the reference configuration [m].
    Point(BodyId, [T; 3]),
    /// A body.
    Body(BodyId),
    /// A joint.
    Joint(JointId),
    /// A coupling.
    Coupling(CouplingId),
    /// An effect.
    Effect(EffectId),
    /// A signal.
    Signal(SignalId),
    /// The whole scene.
    Scene,
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
    /// A coupling.
    Coupling,
    /// An effect.
    Effect,
    /// A signal.
    Signal,
    /// The whole scene.
    Scene,
}

impl TargetKind {
    /// Its keys in scene files; the first one names the owner. The whole scene has none.
    #[must_use]
    pub const fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Point => &["body", "at"],
            Self::Body => &["body"],
            Self::Joint => &["joint"],
            Self::Coupling => &["coupling"],
            Self::Effect => &["effect"],
            Self::Signal => &["signal"],
            Self::Scene => &[],
        }
    }
}

/// A kind of quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct QuantityRow {
    /// Its name in scene files.
    pub name: &'static str,
    /// Another name that is read.
    pub alias: Option<&'static str>,
    /// What it is of.
    pub target: TargetKind,
    /// Its components.
    pub components: ComponentForm,
    /// Is it read of reactions, which are not unique everywhere?
    pub needs_reactions: bool,
    /// Is it read of effects?
    pub needs_effects: bool,
}

impl QuantityRow {
    /// The row of a quantity that is read of the state alone.
    pub(super) const fn new(
        name: &'static str,
        target: TargetKind,
        components: ComponentForm,
    ) -> Self {
        let (needs_reactions, needs_effects) = (false, false);
        Self { name, alias: None, target, components, needs_reactions, needs_effects }
    }

    /// The same, read of reactions too.
    pub(super) const fn of_reactions(self) -> Self {
        Self { needs_reactions: true, ..self }
    }

    /// The same, read of effects too.
    pub(super) const fn of_effects(self) -> Self {
        Self { needs_effects: true, ..self }
    }

    /// The same with another name that is read.
    pub(super) const fn or(self, alias: &'static str) -> Self {
        Self { alias: Some(alias), ..self }
    }

    /// Is this one of its names?
    #[must_use]
    pub fn has_name(&self, name: &str) -> bool {
        self.name == name || self.alias == Some(name)
    }
}
