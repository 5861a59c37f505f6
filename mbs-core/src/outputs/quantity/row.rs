//! What a quantity says of itself.

use super::components::ComponentForm;

/// What a kind of quantity is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TargetKind {
    /// A material point of a body.
    Point,
    /// A material point of a body, seen from another body.
    RelativePoint,
    /// A body.
    Body,
    /// A body, seen from another one.
    RelativeBody,
    /// The carrier of a wheel, seen from the vehicle body.
    WheelCarrier,
    /// A joint.
    Joint,
    /// A coupling.
    Coupling,
    /// A rolling.
    Rolling,
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
            Self::RelativePoint => &["body", "at", "relative_to", "origin"],
            Self::Body => &["body"],
            Self::RelativeBody => &["body", "relative_to"],
            Self::WheelCarrier => &["body", "relative_to", "side", "up", "forward", "axis"],
            Self::Joint => &["joint"],
            Self::Coupling => &["coupling"],
            Self::Rolling => &["rolling"],
            Self::Effect => &["effect"],
            Self::Signal => &["signal"],
            Self::Scene => &[],
        }
    }
}

impl TargetKind {
    /// Is it seen from another body?
    #[must_use]
    pub const fn is_relative(self) -> bool {
        matches!(self, Self::RelativePoint | Self::RelativeBody | Self::WheelCarrier)
    }
}

/// What a quantity is: docs/OUTPUTS.md is written from it, and has the letters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuantityDefinition {
    /// As it is computed.
    pub formula: &'static str,
    /// The axes of its components, where no `frame` is given.
    pub axes: &'static str,
    /// What a positive number means.
    pub sign: &'static str,
    /// What is in it, and what is not; empty: the formula says all.
    pub contents: &'static str,
}

/// Picture of a quantity of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputPicture {
    /// Nothing is drawn of it.
    Nothing,
    /// The way of its point.
    Trace,
    /// An arrow where it acts.
    Force,
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
    /// What it is.
    pub definition: QuantityDefinition,
    /// Is it read of reactions, which are not unique everywhere?
    pub needs_reactions: bool,
    /// Is it read of effects?
    pub needs_effects: bool,
    /// Is it read of the rotation of its body, of the bodies of its joint, or of the one that it is seen from? It counts for these alone.
    pub needs_rotation: bool,
    /// Picture of the quantity.
    pub picture: OutputPicture,
    /// Is it of the run rather than of the motion? Such numbers do not converge with those of other runs.
    pub is_of_run: bool,
}

impl QuantityRow {
    /// The row of a quantity that is read of the state alone.
    pub(super) const fn new(
        name: &'static str,
        target: TargetKind,
        components: ComponentForm,
        definition: QuantityDefinition,
    ) -> Self {
        Self {
            name,
            alias: None,
            target,
            components,
            definition,
            needs_reactions: false,
            needs_effects: false,
            needs_rotation: true,
            picture: OutputPicture::Nothing,
            is_of_run: false,
        }
    }

    /// The same, read of reactions too.
    pub(super) const fn of_reactions(self) -> Self {
        Self { needs_reactions: true, ..self }
    }

    /// The same, read of effects too.
    pub(super) const fn of_effects(self) -> Self {
        Self { needs_effects: true, ..self }
    }

    /// Row that is read without a rotation.
    pub(super) const fn without_rotation(self) -> Self {
        Self { needs_rotation: false, ..self }
    }

    /// Row with a picture.
    pub(super) const fn drawn_as(self, picture: OutputPicture) -> Self {
        Self { picture, ..self }
    }

    /// The same, of the run itself.
    pub(super) const fn of_the_run(self) -> Self {
        Self { is_of_run: true, ..self }
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
