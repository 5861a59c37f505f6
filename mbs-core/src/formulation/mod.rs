//! Formulation as a program sees it: [`Formulation`] with [`Trials`] and [`Describe`], implemented by the formulation's own crate.

mod describe;
mod trials;

pub use describe::Describe;
pub use trials::Trials;

use crate::Real;
use crate::history::{History, RestoreError};
use crate::model::{Model, State, Terms};
use crate::natural::NaturalModel;
use crate::step::{Step, StepError, StepReport};
use alloc::boxed::Box;
use core::any::Any;
use core::fmt::Debug;

/// One way to step a state in natural coordinates.
///
/// What a formulation keeps beside that state is its own: scratch, what it remembers from step to step, a state in other coordinates.
/// Those that step natural coordinates implement few of the methods: the defaults are theirs.
pub trait Formulation<T: Real, const D: usize>:
    Trials<T, D> + Describe<T, D> + Erased<T, D> + Debug + Send + Sync
{
    /// Advances the state by one step.
    ///
    /// # Errors
    /// [`StepError`]; the natural state is then unchanged.
    fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError>;

    /// Makes the state that of the inputs that are set in it now: what it changes is no part of a trial.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    fn take_inputs(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError>;

    /// Makes the state, just before a signal jumps, that just after, at time `to` [s]: the mechanism stays where it is.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    fn pass_jump(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
        to: T,
    ) -> Result<(), StepError>;

    /// One step of fixed length, from the inputs to the energies at its end: what a loop of such steps calls, once a step.
    ///
    /// # Errors
    /// As for [`step`](Self::step).
    fn advance(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<(StepReport<T>, [f64; 3]), StepError> {
        self.take_inputs(model, state)?;
        self.save_trial();
        self.prepare(model, step, 0, state);
        let report = match self.step(model, step, state) {
            Err(error) if self.strengthen(&error) => {
                let made = self.step(model, step, state);
                made.map_err(|_| {
                    self.restore_trial();
                    error
                })?
            }
            made => made?,
        };
        self.tried(step.dt);
        self.accept();
        Ok((report, self.energies(model, state)))
    }

    /// History from which the next step resumes, beside the natural state.
    fn history(&self) -> History<T>;

    /// Resumes from a history.
    ///
    /// # Errors
    /// [`RestoreError`] where it is of another formulation or model; what is remembered may then be in part that of the history.
    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError>;

    /// The terms of the natural-coordinate model as last evaluated; nothing where other coordinates are stepped.
    fn terms(&self) -> Option<&Terms<T>>;

    /// Kinetic and potential energy, and the work so far [J].
    fn energies(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        energies(model, state, self.terms())
    }

    /// Sets the clock of a state that is not the natural one.
    fn set_time(&mut self, _t: T) {}

    /// Sets the work [J] of a state that is not the natural one.
    fn set_work(&mut self, _work: T) {}

    /// Evaluates the energies anew where they are kept from the last step.
    fn watch(&mut self) {}

    /// Lets an integrator that controls its own steps try at most `n` of them within one step.
    fn set_max_steps(&mut self, _n: u32) {}

    /// May this take over the state of another, of a model with other effects?
    ///
    /// # Errors
    /// [`SwitchError`].
    fn can_take_over(&self, _other: &dyn Formulation<T, D>) -> Result<(), SwitchError> {
        Err(SwitchError::Formulation)
    }

    /// Copies the coordinates and velocities of another that this one can take over; [`refresh`](Self::refresh) makes the rest.
    fn take_over(&mut self, _other: &dyn Formulation<T, D>) {}

    /// Makes accelerations and multipliers consistent at a state that was set from outside.
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    fn refresh(
        &mut self,
        _model: &NaturalModel<T, D>,
        _state: &mut State<T>,
    ) -> Result<(), StepError> {
        Ok(())
    }
}

/// A formulation without its type: every one that can be cloned has it.
pub trait Erased<T: Real, const D: usize> {
    /// This formulation as its own type: options are changed there.
    fn as_any(&self) -> &dyn Any;

    /// This formulation as its own type, to be changed.
    fn as_any_mut(&mut self) -> &mut dyn Any;

    /// A copy, which steps to the same bits; threads are shared.
    fn clone_box(&self) -> Box<dyn Formulation<T, D>>;
}

impl<T: Real, F: Formulation<T, D> + Clone + 'static, const D: usize> Erased<T, D> for F {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn clone_box(&self) -> Box<dyn Formulation<T, D>> {
        Box::new(self.clone())
    }
}

impl<T: Real, const D: usize> Clone for Box<dyn Formulation<T, D>> {
    fn clone(&self) -> Self {
        (**self).clone_box()
    }
}

/// Why a formulation cannot take over the state of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SwitchError {
    /// The formulation has no way to make accelerations consistent between two steps.
    Formulation,
    /// The models have other coordinates, constraints, or measured angles whose turns are counted.
    Coordinates,
}

/// Kinetic and potential energy and the work so far of a natural state [J], by terms that were evaluated there, or by new ones.
pub fn energies<T: Real, M: Model<T>>(
    model: &M,
    state: &State<T>,
    terms: Option<&Terms<T>>,
) -> [f64; 3] {
    let State { t, q, v, .. } = state;
    let potential = match terms {
        Some(terms) => model.potential_energy(q, terms),
        None => {
            let mut terms = model.terms();
            model.set_inputs(*t, state, &mut terms);
            model.evaluate(q, &mut terms);
            model.evaluate_forces(q, v, &mut terms);
            model.potential_energy(q, &terms)
        }
    };
    [model.kinetic_energy(v).to_f64(), potential.to_f64(), state.work.to_f64()]
}

/// Calls `$work` with the model that a team shares, bound to `$shared`. With one thread it is the model itself: through a team's forks small
/// mechanisms take 5 to 8 % more instructions.
#[macro_export]
macro_rules! with_team {
    ($model:expr, $team:expr, |$shared:ident| $work:expr) => {
        if $crate::team::Team::size($team) == 1 {
            let $shared = $model;
            $work
        } else {
            let $shared = &$model.with_team($team);
            $work
        }
    };
}
