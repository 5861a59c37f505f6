//! Interface of a formulation: [`Formulation`] with [`Trials`] and [`Describe`], implemented by each formulation's crate.

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

/// Method that steps a state in natural coordinates.
///
/// Besides this state a formulation has its own data: scratch memory, history, or a state in other coordinates. The default methods
/// are right for formulations that step natural coordinates, which implement few of them.
pub trait Formulation<T: Real, const D: usize>:
    Trials<T, D> + Describe<T, D> + Erased<T, D> + Debug + Send + Sync
{
    /// Advances the state by one step.
    ///
    /// # Errors
    /// [`StepError`]. The natural state is then unchanged.
    fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        step: Step<T>,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError>;

    /// Makes the state consistent with the inputs that are set in it. The change is not part of a trial step.
    ///
    /// # Errors
    /// [`StepError`]. The state is then unchanged.
    fn take_inputs(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError>;

    /// Changes the state just before a jump of a signal to the state just after, at time `to` [s]. The mechanism does not move.
    ///
    /// # Errors
    /// [`StepError`]. The state is then unchanged.
    fn pass_jump(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
        to: T,
    ) -> Result<(), StepError>;

    /// Makes one step of fixed length: sets the inputs, steps, and computes the energies at the end. A loop calls it once a step.
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

    /// History from which the next step continues, besides the natural state.
    fn history(&self) -> History<T>;

    /// Restores a history, so that steps continue from it.
    ///
    /// # Errors
    /// [`RestoreError`] for a history of another formulation or model. The formulation may then have parts of that history.
    fn set_history(&mut self, history: &History<T>) -> Result<(), RestoreError>;

    /// Terms of the natural-coordinate model from the last evaluation; `None` for formulations in other coordinates.
    fn terms(&self) -> Option<&Terms<T>>;

    /// Kinetic energy, potential energy, and work since the start [J].
    fn energies(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [f64; 3] {
        energies(model, state, self.terms())
    }

    /// Sets the time of a formulation's state in other coordinates.
    fn set_time(&mut self, _t: T) {}

    /// Sets the work [J] of a formulation's state in other coordinates.
    fn set_work(&mut self, _work: T) {}

    /// Computes the energies again, for formulations that store them from the last step.
    fn watch(&mut self) {}

    /// Limits an integrator with internal step control to `n` trial steps within one step.
    fn set_max_steps(&mut self, _n: u32) {}

    /// Checks that this formulation can use the state of another formulation, whose model may have other effects.
    ///
    /// # Errors
    /// [`SwitchError`] with the reason why not.
    fn can_take_over(&self, _other: &dyn Formulation<T, D>) -> Result<(), SwitchError> {
        Err(SwitchError::Formulation)
    }

    /// Copies coordinates and velocities of another formulation, if `can_take_over` allows it. [`refresh`](Self::refresh) computes
    /// the rest.
    fn take_over(&mut self, _other: &dyn Formulation<T, D>) {}

    /// Makes accelerations and multipliers consistent with a state that was set by the caller.
    ///
    /// # Errors
    /// [`StepError`]. The state is then unchanged.
    fn refresh(
        &mut self,
        _model: &NaturalModel<T, D>,
        _state: &mut State<T>,
    ) -> Result<(), StepError> {
        Ok(())
    }
}

/// Formulation as a trait object. Every formulation that can be cloned implements it.
pub trait Erased<T: Real, const D: usize> {
    /// Returns this formulation as `Any`, for access to its options.
    fn as_any(&self) -> &dyn Any;

    /// Returns this formulation as mutable `Any`.
    fn as_any_mut(&mut self) -> &mut dyn Any;

    /// Returns a copy, whose steps are bitwise equal. Both use the same threads.
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

/// Reason why a formulation cannot use the state of another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SwitchError {
    /// The formulation cannot make accelerations consistent between two steps.
    Formulation,
    /// The models have different coordinates, constraints or remembered angles.
    Coordinates,
}

/// Kinetic energy, potential energy and work of a natural state [J]. They use `terms` evaluated at this state, or new terms.
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

/// Calls `$work` with the model bound to `$shared`. With several threads the model uses the team. With one thread it is the plain
/// model, because a team costs small mechanisms 5 to 8 % more instructions.
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
