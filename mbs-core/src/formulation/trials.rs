//! Trials of a step, of which the last one is kept and the others are undone.

use crate::Real;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::step::{Step, StepError};

/// Trials of steps as a formulation sees them: where it keeps nothing beside the natural state, nothing is to do.
pub trait Trials<T: Real, const D: usize> {
    /// Saves what stands beside the natural state, so that trials after it can be undone.
    fn save_trial(&mut self) {}

    /// Goes back to what was saved; the natural state is the caller's.
    fn restore_trial(&mut self) {}

    /// Called before a trial that follows `reductions` of it in a row; says whether it has changed the state.
    fn prepare(
        &mut self,
        _model: &NaturalModel<T, D>,
        _step: Step<T>,
        _reductions: u32,
        _state: &mut State<T>,
    ) -> bool {
        false
    }

    /// A step of fixed length has failed: does the next trial of it go otherwise? Then so do the steps after it, until the trial is
    /// [undone](Self::restore_trial).
    fn strengthen(&mut self, _error: &StepError) -> bool {
        false
    }

    /// A trial of length `dt` [s] has come to its end, whether it is accepted or not.
    fn tried(&mut self, _dt: T) {}

    /// The last trial is the step.
    fn accept(&mut self) {}
}
