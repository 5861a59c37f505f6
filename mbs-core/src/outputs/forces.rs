//! Forces at a state for outputs: reactions, efforts, and wrenches of effects.

use super::error::ReactionError;
use super::exerted::EffectWrenches;
use super::reaction::Reactions;
use crate::Real;
use crate::mechanism::{Output, Scene};
use crate::model::State;
use crate::natural::NaturalModel;

/// Reactions and effects that the outputs of a scene need.
#[derive(Debug, Clone)]
pub struct Forces<T: Real, const D: usize> {
    reactions: Option<Reactions<T, D>>,
    effects: Option<EffectWrenches<T, D>>,
}

impl<T: Real, const D: usize> Forces<T, D> {
    /// Prepares reactions and effects if the outputs of a checked scene need them.
    ///
    /// # Errors
    /// The errors of [`Reactions::new`].
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ReactionError> {
        Self::of_outputs(&scene.outputs, scene, model)
    }

    /// Prepares reactions and effects if these outputs need them, independent of the outputs of the scene.
    ///
    /// # Errors
    /// The errors of [`Reactions::new`].
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

    /// Evaluates reactions and effects at a consistent state. Cost: as [`Reactions::update`], and the signals of effects.
    pub fn update(&mut self, state: &State<T>) {
        self.reactions.iter_mut().for_each(|reactions| reactions.update(state));
        self.effects.iter_mut().for_each(|effects| effects.update(state));
    }

    /// Reactions; `None` if no output needs them.
    #[must_use]
    pub fn reactions(&self) -> Option<&Reactions<T, D>> {
        self.reactions.as_ref()
    }

    /// Effects; `None` if no output needs them.
    pub(super) fn effects(&self) -> Option<&EffectWrenches<T, D>> {
        self.effects.as_ref()
    }
}
