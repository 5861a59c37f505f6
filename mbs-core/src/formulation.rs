//! Formulation as a program sees it: [`Formulation`], implemented by the formulation's own crate.

use crate::Real;
use crate::history::{History, RestoreError};
use crate::laws::code::Codes;
use crate::model::{Model, Owner, State, Terms};
use crate::natural::NaturalModel;
use crate::step::{Step, StepError, StepReport};
use alloc::boxed::Box;
use core::any::Any;
use core::fmt::Debug;

/// One way to step a state in natural coordinates.
///
/// What a formulation keeps beside that state is its own: scratch, what it remembers from step to step, a state in other coordinates.
/// Those that step natural coordinates implement few of the methods: the defaults are theirs.
pub trait Formulation<T: Real, const D: usize>: Debug + Send + Sync + Erased<T, D> {
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

    /// Saves what stands beside the natural state, so that trials after it can be undone.
    fn save_trial(&mut self) {}

    /// Goes back to what was saved; the natural state is the caller's.
    fn restore_trial(&mut self) {}

    /// History from which the next step resumes, beside the natural state.
    fn history(&self) -> History<T>;

    /// Resumes from a history.
    ///
    /// # Errors
    /// [`RestoreError`] where it is of another formulation or model; what is remembered may then be in part that of the history.
    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError>;

    /// The terms of the natural-coordinate model as last evaluated; nothing where other coordinates are stepped.
    fn terms(&self) -> Option<&Terms<T>>;

    /// The user-defined laws by which it steps: whether one of them failed.
    fn codes<'a>(&'a self, model: &'a NaturalModel<T, D>) -> &'a Codes {
        model.codes()
    }

    /// Kinetic and potential energy, and the work so far [J].
    fn energies(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        energies(model, state, self.terms())
    }

    /// Coordinates, constraints and their rank at the start, where other coordinates than natural ones are stepped.
    fn sizes(&self) -> Option<[usize; 3]> {
        None
    }

    /// Threads that share the work of a step, this one among them.
    fn threads(&self) -> usize {
        1
    }

    /// The index in which the next step would be made, and the changes of it so far; nothing where there is none.
    fn index(&self) -> Option<(u8, u32)> {
        None
    }

    /// An angle or slide of a joint with its turns, by joint and number, where the formulation's own coordinates have it.
    fn coordinate(&self, _joint: usize, _number: usize) -> Option<T> {
        None
    }

    /// Part of the scene that an unknown of the formulation belongs to.
    fn owner_of_unknown(&self, model: &NaturalModel<T, D>, unknown: usize) -> Owner {
        model.owner_of_unknown(unknown)
    }

    /// Part of the scene that a constraint row of the formulation belongs to.
    fn owner_of_row(&self, model: &NaturalModel<T, D>, row: usize) -> Owner {
        model.owner_of_row(row)
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
