//! Wrenches that effects exert on bodies, in the form that reactions need.

use super::frame::Frame;
use super::load::{Load, Loads};
use super::rotor::RotorTorque;
use super::wrench::Wrench;
use crate::Real;
use crate::algebra::Matrix;
use crate::laws::body::TireForces;
use crate::laws::scalar::ScalarForce;
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{ModelError, NaturalModel};
use crate::scene::BodyId;
use alloc::vec::Vec;

/// Wrenches of the effects of a scene.
#[derive(Debug, Clone)]
pub struct EffectWrenches<T: Real, const D: usize> {
    loads: Loads<T, D>,
    /// Index of the effect of each load.
    effects: Vec<usize>,
    rotors: Vec<RotorTorque<T, D>>,
    frames: Vec<Frame<T, D>>,
    ground: Frame<T, D>,
}

impl<T: Real, const D: usize> EffectWrenches<T, D> {
    /// Prepares the enabled effects of a checked scene.
    ///
    /// # Errors
    /// [`ModelError`] as when the model is built.
    pub fn new(scene: &Scene<T>, model: &NaturalModel<T, D>) -> Result<Self, ModelError> {
        let (loads, effects) = Loads::new(scene, model)?;
        let frame = |body| Frame::new(model, body);
        let frames = (0..scene.bodies.len()).map(|body| frame(BodyId::Body(body))).collect();
        let rotors = RotorTorque::all(scene, model);
        Ok(Self { loads, effects, rotors, frames, ground: frame(BodyId::Ground) })
    }

    /// Sets the signals of effects to the values of a state.
    pub fn update(&mut self, state: &State<T>) {
        self.loads.update(state);
    }

    /// Wrench of an effect at a state in global axes, on its body or on the second of its two bodies. The moment is about the attachment
    /// point on this body, in its present position. An effect on an angle has a moment only. The wrench is zero for an effect that does not
    /// exist or is disabled.
    ///
    /// Cost: one evaluation of the effect's laws, and one comparison for each other effect; no allocation.
    pub fn of(&mut self, effect: usize, state: &State<T>) -> Wrench<T> {
        self.update(state);
        self.wrench(effect, state)
    }

    /// Wrench of an effect at the state of the last [`update`](Self::update).
    pub(super) fn wrench(&self, effect: usize, state: &State<T>) -> Wrench<T> {
        let law_inputs = self.loads.law_inputs();
        let mut sum = Wrench::zero();
        for load in self.loads_of(Some(effect)) {
            // A load between two bodies passes the wrench on the second body last.
            let mut last = Wrench::zero();
            let turned = |body| self.turned(body, state);
            load.apply((state, &law_inputs), &turned, &mut |(_, _, wrench)| last = wrench);
            sum.add(&last);
        }
        if let Some(rotor) = self.rotor(effect) {
            rotor.apply(state, &mut |(_, _, wrench)| sum = wrench);
        }
        sum
    }

    /// Value, rate and tension of an effect along a line or on a joint; zeros for other effects.
    pub(super) fn scalar(&self, effect: usize, state: &State<T>) -> ScalarForce<T> {
        if let Some(rotor) = self.rotor(effect) {
            return rotor.scalar(state);
        }
        let law_inputs = self.loads.law_inputs();
        let mut loads = self.loads_of(Some(effect));
        loads.find_map(|load| load.scalar(state, &law_inputs)).unwrap_or_default()
    }

    /// True if the effect exists and is enabled.
    pub(super) fn is_there(&self, effect: usize) -> bool {
        self.effects.contains(&effect)
    }

    /// Depth of the deepest contact of an effect: minus its smallest gap, or zero without a contact.
    pub(super) fn depth(&self, effect: usize, state: &State<T>) -> T {
        let law_inputs = self.loads.law_inputs();
        self.loads_of(Some(effect)).fold(T::ZERO, |depth, load| {
            let gaps = load.reading(state, &law_inputs).gaps;
            gaps.iter().take(load.n_gaps()).fold(depth, |depth, gap| depth.max(-gap.value))
        })
    }

    /// Forces of the road on a tire; zeros for other effects, and for an effect that does not exist.
    pub(super) fn tire(&self, effect: usize, state: &State<T>) -> TireForces<T> {
        let law_inputs = self.loads.law_inputs();
        let turned = |body| self.turned(body, state);
        let mut loads = self.loads_of(Some(effect));
        loads.find_map(|load| load.tire((state, &law_inputs), &turned)).unwrap_or_default()
    }

    /// Value, rate and acceleration of a signal.
    pub(super) fn signal(&self, signal: usize) -> [T; 3] {
        self.loads.law_inputs().courses.get(signal).copied().unwrap_or([T::ZERO; 3])
    }

    /// Energy stored in an effect [J]; for a rotor its kinetic energy. If `effect` is `None`, it is the energy of all effects except
    /// rotors.
    pub(super) fn energy(&self, effect: Option<usize>, state: &State<T>) -> T {
        if let Some(rotor) = effect.and_then(|effect| self.rotor(effect)) {
            return rotor.kinetic_energy(state);
        }
        let law_inputs = self.loads.law_inputs();
        let turned = |body| self.turned(body, state);
        let loads = self.loads_of(effect);
        loads.fold(T::ZERO, |sum, load| sum + load.energy((state, &law_inputs), &turned))
    }

    /// Power that an effect supplies to bodies [W].
    pub(super) fn power(&self, effect: usize, state: &State<T>) -> T {
        if let Some(rotor) = self.rotor(effect) {
            return rotor.power(state);
        }
        let law_inputs = self.loads.law_inputs();
        let turned = |body| self.turned(body, state);
        let loads = self.loads_of(Some(effect));
        loads.fold(T::ZERO, |sum, load| sum + load.power((state, &law_inputs), &turned))
    }

    /// Rotor of this effect; `None` for other effects.
    fn rotor(&self, effect: usize) -> Option<&RotorTorque<T, D>> {
        self.rotors.iter().find(|rotor| rotor.effect == effect)
    }

    /// Loads of one effect, or of all effects.
    fn loads_of(&self, effect: Option<usize>) -> impl Iterator<Item = &Load<T, D>> {
        let all = self.loads.list().iter().zip(&self.effects);
        all.filter(move |(_, of)| effect.is_none_or(|effect| **of == effect)).map(|(load, _)| load)
    }

    fn turned(&self, body: BodyId, state: &State<T>) -> Matrix<T, 3> {
        match body {
            BodyId::Ground => self.ground.rotation(&state.q),
            BodyId::Body(body) => self.frames[body].rotation(&state.q),
        }
    }
}
