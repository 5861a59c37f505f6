//! The formulation of a run, with everything its steps need.

use crate::choice::Formulation;
use crate::settings::Settings;
use crate::simulation::rank;
use crate::stop::StopError;
use mbs_augmented::{Options, Penalty, Workspace, index1, index3};
use mbs_core::model::{Model, Owner, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::step::{StepError, StepReport};
use mbs_core::{Cliques, Real};
use mbs_sparse::Multifrontal;

/// One of the formulations, chosen once per run.
#[derive(Debug)]
pub enum Engine<T: Real, const D: usize> {
    /// Index-3 or index-1 augmented Lagrangian.
    Augmented {
        /// Index-1?
        is_index1: bool,
        /// Its options.
        options: Options<T>,
        /// Its scratch.
        workspace: Box<Workspace<T, Multifrontal<T>>>,
    },
}

impl<T: Real, const D: usize> Engine<T, D> {
    pub(crate) fn new(
        scene: &Scene<T>,
        settings: &Settings,
        model: &NaturalModel<T, D>,
        solver: Multifrontal<T>,
        state: &mut State<T>,
    ) -> Result<Self, StopError> {
        let _ = (scene, state);
        match settings.formulation {
            Formulation::Index1 | Formulation::Index3 => {
                let is_index1 = settings.formulation == Formulation::Index1;
                let options = augmented(is_index1, settings);
                let workspace = Box::new(Workspace::new(model, solver));
                Ok(Self::Augmented { is_index1, options, workspace })
            }
            _ => todo!(),
        }
    }

    /// Advances the state by `dt` [s].
    pub(crate) fn step(
        &mut self,
        model: &NaturalModel<T, D>,
        dt: T,
        state: &mut State<T>,
    ) -> Result<StepReport<T>, StepError> {
        let step = (dt, model.length());
        match self {
            Self::Augmented { is_index1: false, options, workspace } => {
                index3::step(model, step, options, state, workspace)
            }
            Self::Augmented { is_index1: true, options, workspace } => {
                index1::step(model, step, options, state, workspace)
            }
        }
    }

    /// Sets the clock of states that are not the natural one.
    pub(crate) fn set_time(&mut self, _t: T) {}

    /// Kinetic and potential energy at the start [J].
    pub(crate) fn start_energies(&self, model: &NaturalModel<T, D>, s: &State<T>) -> [f64; 2] {
        let mut terms = model.terms();
        model.set_inputs(s.t, &mut terms);
        model.evaluate(&s.q, &mut terms);
        model.evaluate_forces(&s.q, &s.v, &s.memory, &mut terms);
        [model.kinetic_energy(&s.v).to_f64(), model.potential_energy(&s.q, &terms).to_f64()]
    }

    /// Kinetic and potential energy and the work so far [J].
    pub(crate) fn energies(&self, model: &NaturalModel<T, D>, s: &State<T>) -> [f64; 3] {
        let kinetic = model.kinetic_energy(&s.v).to_f64();
        let potential = model.potential_energy(&s.q, self.terms()).to_f64();
        [kinetic, potential, s.work.to_f64()]
    }

    fn terms(&self) -> &Terms<T> {
        match self {
            Self::Augmented { workspace, .. } => workspace.terms(),
        }
    }

    /// Coordinates, constraints and their rank at a state.
    pub(crate) fn sizes(&self, model: &NaturalModel<T, D>, state: &State<T>) -> [usize; 3] {
        [model.n_unknowns(), model.n_constraints(), rank(model, state)]
    }

    /// What an unknown of the formulation belongs to.
    pub(crate) fn owner_of_unknown(&self, model: &NaturalModel<T, D>, u: usize) -> Option<Owner> {
        Some(model.owner_of_unknown(u))
    }

    /// What a constraint row of the formulation belongs to.
    pub(crate) fn owner_of_row(&self, model: &NaturalModel<T, D>, row: usize) -> Option<Owner> {
        Some(model.owner_of_row(row))
    }
}

fn augmented<T: Real>(is_index1: bool, settings: &Settings) -> Options<T> {
    let mut options = if is_index1 { Options::index1() } else { Options::index3() };
    options.integrator = settings.integrator.coefficients();
    if let Some(alpha) = settings.penalty {
        options.penalty = Penalty::Fixed(T::from_f64(alpha));
        options.adaptive_penalty = false;
    }
    if let Some(tolerance) = settings.tolerance {
        options.tolerance = T::from_f64(tolerance);
    }
    options
}
