//! Forces of a state, as outputs read them: reactions and efforts, and what effects do.

use super::error::ReactionError;
use super::exerted::EffectWrenches;
use super::reaction::Reactions;
use crate::Real;
use crate::mechanism::{Output, Scene};
use crate::model::State;
use crate::natural::NaturalModel;

/// Reactions and effects, where outputs of a scene ask for them.
#[derive(Debug, Clone)]
pub struct Forces<T: Real, const D: usize> {
    reactions: Option<Reactions<T, D>>,
    effects: Option<EffectWrenches<T, D>>,
}

impl<T: Real, const D: usize> Forces<T, D> {
    /// Prepares what the outputs of a scene that passed its check ask for; nothing, where they ask for none.
    ///
    /// # Errors
    /// As [`Reactions::new`].
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ReactionError> {
        Self::of_outputs(&scene.outputs, scene, model)
    }

    /// Prepares what these outputs ask for, whatever outputs the scene has.
    ///
    /// # Errors
    /// As [`Reactions::new`].
    pub fn of_outputs(
        outputs: &[Output<T>],
        scene: &Scene<T>,
        model: &NaturalModel<T, D>,
    ) -> Result<Self, ReactionError> {
        let asked = |asks: fn(&Output<T>) -> bool| outputs.iter().any(asks);
        let reactions = asked(|output| output.quantity.row().needs_reactions);
        let effects = asked(|output| output.quantity.row().needs_effects);
        Ok(Self {
            reactions: reactions.then(|| Reactions::new(scene, model)).transpose()?,
            effects: effects.then(|| EffectWrenches::new(scene, model)).transpose()?,
        })
    }

    /// Evaluates them at a consistent state. Cost: as [`Reactions::update`]; the functions of time that effects follow.
    pub fn update(&mut self, state: &State<T>) {
        self.reactions.iter_mut().for_each(|reactions| reactions.update(state));
        self.effects.iter_mut().for_each(|effects| effects.update(state));
    }

    /// The reactions, where an output asks for them.
    #[must_use]
    pub fn reactions(&self) -> Option<&Reactions<T, D>> {
        self.reactions.as_ref()
    }

    /// The effects, where an output asks for them.
    pub(super) fn effects(&self) -> Option<&EffectWrenches<T, D>> {
        self.effects.as_ref()
    }
}
