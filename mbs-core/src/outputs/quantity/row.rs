//! Row of a quantity in the table of quantities: its name, target, components and definition.

use super::components::ComponentForm;

/// Kind of target that a quantity measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TargetKind {
    /// Material point of a body.
    Point,
    /// Material point of a body, relative to another body.
    RelativePoint,
    /// Body of the scene.
    Body,
    /// Body relative to another body.
    RelativeBody,
    /// Carrier of a wheel, relative to the vehicle body.
    WheelCarrier,
    /// Joint of the scene.
    Joint,
    /// Coupling of the scene.
    Coupling,
    /// Rolling contact of the scene.
    Rolling,
    /// Effect of the scene.
    Effect,
    /// Signal of the scene.
    Signal,
    /// The scene as a whole.
    Scene,
}

impl TargetKind {
    /// Keys of the target in scene files. The first one names the owner. The scene as a whole has no keys.
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
    /// True if the quantity is relative to another body.
    #[must_use]
    pub const fn is_relative(self) -> bool {
        matches!(self, Self::RelativePoint | Self::RelativeBody | Self::WheelCarrier)
    }
}

/// Definition of a quantity. docs/OUTPUTS.md is written from it and explains the symbols.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct QuantityDefinition {
    /// Formula by which the quantity is computed.
    pub formula: &'static str,
    /// Axes of its components, unless the output sets a `frame`.
    pub axes: &'static str,
    /// Meaning of a positive value.
    pub sign: &'static str,
    /// Contributions that the quantity includes or leaves out. Empty: the formula says all.
    pub contents: &'static str,
}

/// Picture of an output's quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutputPicture {
    /// Nothing is drawn for the output.
    Nothing,
    /// Path of its point.
    Trace,
    /// Arrow at the point where the force acts.
    Force,
}

/// Row of a kind of quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct QuantityRow {
    /// Name of the quantity in scene files.
    pub name: &'static str,
    /// Second name that scene files may use.
    pub alias: Option<&'static str>,
    /// Kind of target that the quantity measures.
    pub target: TargetKind,
    /// Form of the components.
    pub components: ComponentForm,
    /// Definition of the quantity.
    pub definition: QuantityDefinition,
    /// True if the quantity needs reactions, which are not always unique.
    pub needs_reactions: bool,
    /// True if the quantity needs effects.
    pub needs_effects: bool,
    /// True if the quantity needs the rotation of its body, of its joint's bodies, or of the body to which it is relative.
    pub needs_rotation: bool,
    /// Picture of the quantity.
    pub picture: OutputPicture,
    /// True if the quantity belongs to the numerical run and not to the motion. Its values do not converge to those of other runs.
    pub is_of_run: bool,
}

impl QuantityRow {
    /// Row of a quantity that is computed from the state alone.
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

    /// Row that also needs reactions.
    pub(super) const fn of_reactions(self) -> Self {
        Self { needs_reactions: true, ..self }
    }

    /// Row that also needs effects.
    pub(super) const fn of_effects(self) -> Self {
        Self { needs_effects: true, ..self }
    }

    /// Row that needs no rotation.
    pub(super) const fn without_rotation(self) -> Self {
        Self { needs_rotation: false, ..self }
    }

    /// Row with a picture.
    pub(super) const fn drawn_as(self, picture: OutputPicture) -> Self {
        Self { picture, ..self }
    }

    /// Row of a quantity that belongs to the run.
    pub(super) const fn of_the_run(self) -> Self {
        Self { is_of_run: true, ..self }
    }

    /// Row with another name that scene files may use.
    pub(super) const fn or(self, alias: &'static str) -> Self {
        Self { alias: Some(alias), ..self }
    }

    /// True if this is a name of the quantity.
    #[must_use]
    pub fn has_name(&self, name: &str) -> bool {
        self.name == name || self.alias == Some(name)
    }
}
