//! Measurement of outputs at the states of a linearisation.

use crate::error::LinearError;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::model::{Model, State, Terms};

/// Measures outputs at a state; q, v, a, multipliers (`reaction`), measured angles, signals and inputs belong to the same instant.
pub type OutputMeasure<'a, T> = dyn FnMut(&State<T>) -> Result<Vec<T>, LinearError> + 'a;

/// Measure of the outputs, and the state that is passed to it.
pub(crate) struct Watch<'a, T> {
    measure: &'a mut OutputMeasure<'a, T>,
    state: State<T>,
}

/// Coordinates, velocities, accelerations and multipliers.
pub(crate) type Motion<'a, T> = [&'a [T]; 4];

impl<'a, T: Real> Watch<'a, T> {
    /// Creates a watch that starts from a state.
    pub(crate) fn new(measure: &'a mut OutputMeasure<'a, T>, s: &State<T>) -> Self {
        let mut state = s.clone();
        state.q_low.fill(T::ZERO);
        Self { measure, state }
    }

    /// Sets the input with index `place`.
    pub(crate) fn set_input(&mut self, place: usize, value: T) {
        self.state.inputs[place] = value;
        self.state.applied[place] = value;
    }

    /// Returns the outputs for this motion. The model's terms must be those evaluated for it.
    pub(crate) fn outputs(
        &mut self,
        (model, terms): (&impl Model<T>, &Terms<T>),
        [q, v, a, lambda]: Motion<'_, T>,
    ) -> Result<Vec<T>, LinearError> {
        let s = &mut self.state;
        for (to, from) in [(&mut s.q, q), (&mut s.v, v), (&mut s.a, a), (&mut s.a_aux, a)] {
            to.copy_from_slice(from);
        }
        for to in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
            to.copy_from_slice(lambda);
        }
        s.phi.copy_from_slice(&terms.phi);
        s.signals.copy_from_slice(&terms.signals);
        model.remember(&s.q, terms, &mut s.memory);
        s.power = model.power(&s.q, &s.v, &s.reaction, terms);
        (self.measure)(s)
    }
}
