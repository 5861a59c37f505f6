//! A scene that can step: model, consistent state and scratch in one place.

use crate::settings::{Formulation, Settings};
use mbs_augmented::{Options, StepError, StepReport, Workspace, index1, index3};
use mbs_core::Cliques;
use mbs_core::Real;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::start::{Assembled, AssemblyError, assemble, constraint_rank};
use mbs_sparse::Multifrontal;

/// A scene ready to step, in D dimensions and scalar T.
#[derive(Debug)]
pub struct Simulation<T: Real, const D: usize> {
    model: NaturalModel<T, D>,
    state: State<T>,
    workspace: Workspace<T, Multifrontal<T>>,
    options: Options<T>,
    formulation: Formulation,
    /// What assembly did; the state in it is the start.
    pub start: Assembled<T>,
    /// Rank of the constraints at the start.
    pub rank: usize,
    initial_energy: [f64; 2],
}

/// Why a scene cannot start.
pub type StartError = AssemblyError;

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Builds the model of a scene, assembles it, and allocates everything a step needs.
    ///
    /// # Errors
    /// [`AssemblyError`] when there is no model or no consistent start.
    pub fn new(scene: &Scene<T>, settings: &Settings) -> Result<Self, StartError> {
        let model = NaturalModel::<T, D>::new(scene)?;
        let analyse = mbs_sparse::Options::default();
        let mut solver = Multifrontal::analyse(&model, analyse);
        let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver)?;
        let mut terms = model.terms();
        model.set_inputs(T::ZERO, &mut terms);
        model.evaluate(&start.state.q, &mut terms);
        model.evaluate_forces(&start.state.q, &start.state.v, &start.state.memory, &mut terms);
        let rank = constraint_rank(&model, &terms).unwrap_or_else(|| model.n_constraints());
        let kinetic = model.kinetic_energy(&start.state.v).to_f64();
        let potential = model.potential_energy(&start.state.q, &terms).to_f64();
        let workspace = Workspace::new(&model, solver);
        Ok(Self {
            state: start.state.clone(),
            model,
            workspace,
            options: settings.options(),
            formulation: settings.formulation,
            start,
            rank,
            initial_energy: [kinetic, potential],
        })
    }

    /// Advances by one step of length `dt` [s].
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    pub fn step(&mut self, dt: T) -> Result<StepReport<T>, StepError> {
        let step = (dt, self.model.length());
        match self.formulation {
            Formulation::Index3 => {
                index3::step(&self.model, step, &self.options, &mut self.state, &mut self.workspace)
            }
            Formulation::Index1 => {
                index1::step(&self.model, step, &self.options, &mut self.state, &mut self.workspace)
            }
        }
    }

    /// Sets the clock: sums of many steps drift, multiples do not.
    pub fn set_time(&mut self, t: T) {
        self.state.t = t;
    }

    /// The model.
    pub fn model(&self) -> &NaturalModel<T, D> {
        &self.model
    }

    /// The state.
    pub fn state(&self) -> &State<T> {
        &self.state
    }

    /// Options, to change before a run.
    pub fn options_mut(&mut self) -> &mut Options<T> {
        &mut self.options
    }

    /// Kinetic energy, potential energy, and work of dampers, guides and courses since the start [J].
    pub fn energies(&self) -> [f64; 3] {
        let s = &self.state;
        let kinetic = self.model.kinetic_energy(&s.v).to_f64();
        let potential = self.model.potential_energy(&s.q, self.workspace.terms()).to_f64();
        [kinetic, potential, s.work.to_f64()]
    }

    /// The same at the start.
    pub fn initial_energies(&self) -> [f64; 3] {
        [self.initial_energy[0], self.initial_energy[1], 0.0]
    }

    /// Coordinates, constraints, rank.
    pub fn sizes(&self) -> [usize; 3] {
        [self.model.n_unknowns(), self.model.n_constraints(), self.rank]
    }
}
