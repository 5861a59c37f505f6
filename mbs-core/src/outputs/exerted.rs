//! What effects exert on bodies, as reactions take it.

use super::frame::Frame;
use super::load::Loads;
use super::wrench::Wrench;
use crate::Real;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use crate::scene::{BodyId, Scene};
use alloc::vec::Vec;

/// The wrenches of a scene's effects.
#[derive(Debug, Clone)]
pub struct EffectWrenches<T: Real, const D: usize> {
    loads: Loads<T, D>,
    /// The effect of each load.
    effects: Vec<usize>,
    frames: Vec<Frame<T, D>>,
    ground: Frame<T, D>,
}

impl<T: Real, const D: usize> EffectWrenches<T, D> {
    /// Prepares the enabled effects of a scene that passed its check.
    ///
    /// # Errors
    /// [`ModelError`] as for the model.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        let (loads, effects) = Loads::new(scene, model)?;
        let frame = |body| Frame::new(scene, model, body);
        let frames = (0..scene.bodies.len()).map(|body| frame(BodyId::Body(body))).collect();
        Ok(Self { loads, effects, frames, ground: frame(BodyId::Ground) })
    }

    /// What an effect exerts at a state: on its body, or on the second of its two, global axes. The moment is about the point of that body where
    /// the effect is attached, as it has moved; an effect about an angle has a moment alone. Zero where the effect is not there.
    ///
    /// Cost: one evaluation of the effect's laws, and one look at each other effect; no allocation.
    pub fn of(&mut self, effect: usize, state: &State<T>) -> Wrench<T> {
        let Self { loads, effects, frames, ground } = self;
        let (list, law_inputs) = loads.at(state);
        let mut sum = Wrench::zero();
        for (load, _) in list.iter().zip(effects).filter(|(_, owner)| **owner == effect) {
            let turned = |body| match body {
                BodyId::Ground => ground.rotation(&state.q),
                BodyId::Body(body) => frames[body].rotation(&state.q),
            };
            // the second of two bodies comes last
            let mut last = Wrench::zero();
            load.apply((state, &law_inputs), turned, |(_, _, wrench)| last = wrench);
            sum.add(&last);
        }
        sum
    }
}
