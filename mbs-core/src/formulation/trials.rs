//! Trial steps: the last one is accepted, and the others are undone.

use crate::Real;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::step::{Step, StepError};

/// Trial steps of a formulation. The default methods are right for formulations without data besides the natural state.
pub trait Trials<T: Real, const D: usize> {
    /// Saves the data besides the natural state, so that later trials can be undone.
    fn save_trial(&mut self) {}

    /// Restores the saved data. The caller restores the natural state.
    fn restore_trial(&mut self) {}

    /// Prepares a trial that follows `reductions` reductions of the step in a row. Returns whether it changed the state.
    fn prepare(
        &mut self,
        _model: &NaturalModel<T, D>,
        _step: Step<T>,
        _reductions: u32,
        _state: &mut State<T>,
    ) -> bool {
        false
    }

    /// Reacts to a failed step of fixed length. Returns whether the next trial uses a different method. Later steps then use it
    /// too, until the trial is [undone](Self::restore_trial).
    fn strengthen(&mut self, _error: &StepError) -> bool {
        false
    }

    /// Notes that a trial of length `dt` [s] has ended, accepted or not.
    fn tried(&mut self, _dt: T) {}

    /// Accepts the last trial as the step.
    fn accept(&mut self) {}
}
