//! The formulation of a run, with everything its steps need.

use crate::choice::FormulationKind;
use crate::settings::Settings;
use crate::stop::StopError;
use crate::tree::{InSpace, Plane, Tree};
use mbs_augmented::{IndexChange, Penalty, index1, index3};
use mbs_classical as classical;
use mbs_core::model::{Model, Owner, State, Terms};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::Scene;
use mbs_core::step::{StepError, StepReport};
use mbs_core::team::Team;
use mbs_core::{Cliques, Real};
use mbs_parallel::{Threads, most_threads};
use mbs_sparse::{Indefinite, Multifrontal};
use mbs_statespace as statespace;

/// One of the formulations, chosen once per run.
#[derive(Debug)]
pub enum Engine<T: Real, const D: usize>
where
    Plane<D>: InSpace<T>,
{
    /// Index-3 or index-1 augmented Lagrangian, or both by turns.
    Augmented {
        /// Which index, with its options.
        index: Index<T>,
        /// Its scratch.
        workspace: Box<mbs_augmented::Workspace<T, Multifrontal<T, Threads>>>,
        /// Who shares the work of its steps.
        team: Threads,
    },
    /// Index-3 classical Lagrangian.
    Classical {
        /// Its options.
        options: classical::Options<T>,
        /// Its scratch.
        workspace: Box<classical::Workspace<T, Indefinite<T, Threads>>>,
        /// Who shares the work of its steps.
        team: Threads,
    },
    /// State space.
    StateSpace {
        /// Its options.
        options: statespace::Options<T>,
        /// Its scratch.
        workspace: Box<statespace::Workspace<T>>,
    },
    /// Relative coordinates.
    Recursive(Box<Tree<T, D>>),
}

/// Which index the augmented Lagrangian is stepped in.
#[derive(Debug, Clone, Copy)]
pub enum Index<T> {
    /// Index-1.
    One(mbs_augmented::Options<T>),
    /// Index-3.
    Three(mbs_augmented::Options<T>),
    /// Index-3 for long steps, index-1 for short ones.
    Both(IndexChange<T>),
}

impl<T: Real> Index<T> {
    /// Advances the state by one step of (dt [s], scene's length [m]).
    fn step<M: Model<T>, S: mbs_core::SpdSolver<T>>(
        &mut self,
        model: &M,
        step: (T, T),
        state: &mut State<T>,
        workspace: &mut mbs_augmented::Workspace<T, S>,
    ) -> Result<StepReport<T>, StepError> {
        match self {
            Self::One(options) => index1::step(model, step, options, state, workspace),
            Self::Three(options) => index3::step(model, step, options, state, workspace),
            Self::Both(change) => change.step(model, step, state, workspace),
        }
    }
}

impl<T: Real, const D: usize> Engine<T, D>
where
    Plane<D>: InSpace<T>,
{
    pub(crate) fn new(
        scene: &Scene<T>,
        settings: &Settings,
        model: &NaturalModel<T, D>,
        solver: Multifrontal<T>,
        state: &mut State<T>,
    ) -> Result<Self, StopError> {
        match settings.formulation {
            FormulationKind::Index1 | FormulationKind::Index3 | FormulationKind::MultiIndex => {
                let [one, three] = augmented_options(settings);
                let index = match settings.formulation {
                    FormulationKind::Index1 => Index::One(one),
                    FormulationKind::Index3 => Index::Three(three),
                    _ => Index::Both(IndexChange::new(one, three)),
                };
                let team = team(settings, solver.n_branches())?;
                let solver = solver.with_team(team.clone());
                let workspace = Box::new(mbs_augmented::Workspace::new(model, solver));
                Ok(Self::Augmented { index, workspace, team })
            }
            FormulationKind::Classical => {
                let options = classical_options(settings);
                let saddle = classical::Saddle::new(model);
                let solver = Indefinite::analyse(&saddle, mbs_sparse::Options::default());
                let team = team(settings, solver.n_branches())?;
                let solver = solver.with_team(team.clone());
                let workspace = Box::new(classical::Workspace::new(model, solver));
                Ok(Self::Classical { options, workspace, team })
            }
            FormulationKind::StateSpace => {
                let mut options = statespace::Options {
                    integrator: settings.integrator.coefficients(),
                    ..statespace::Options::default()
                };
                if let Some(tolerance) = settings.tolerance {
                    options.tolerance = T::from_f64(tolerance);
                }
                let workspace = Box::new(statespace::Workspace::new(model, state));
                Ok(Self::StateSpace { options, workspace })
            }
            FormulationKind::Recursive => {
                let tree = Tree::new(scene, settings, model, state)?;
                Ok(Self::Recursive(Box::new(tree)))
            }
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
        // The steps stand twice, for one thread and for a team: through the team's forks alone small mechanisms take 5 to 8 % more instructions.
        match self {
            Self::Augmented { index, workspace, team: Threads::One } => {
                index.step(model, step, state, workspace)
            }
            Self::Augmented { index, workspace, team } => {
                index.step(&model.with_team(team), step, state, workspace)
            }
            Self::Classical { options, workspace, team: Threads::One } => {
                classical::index3::step(model, step, options, state, workspace)
            }
            Self::Classical { options, workspace, team } => {
                classical::index3::step(&model.with_team(team), step, options, state, workspace)
            }
            Self::StateSpace { options, workspace } => {
                statespace::step(model, step, options, state, workspace)
            }
            Self::Recursive(tree) => tree.step(model, dt, state),
        }
    }

    /// Makes the state that of the inputs that are set now: what it changes is no part of a trial.
    pub(crate) fn take_inputs(
        &mut self,
        model: &NaturalModel<T, D>,
        state: &mut State<T>,
    ) -> Result<(), StepError> {
        match self {
            Self::Augmented { workspace, .. } => {
                mbs_augmented::take_inputs(model, state, workspace).map(drop)
            }
            Self::Classical { options, workspace, .. } => {
                classical::take_inputs(model, options, state, workspace).map(drop)
            }
            Self::StateSpace { workspace, .. } => {
                statespace::take_inputs(model, state, workspace).map(drop)
            }
            Self::Recursive(tree) => tree.take_inputs(model, state),
        }
    }

    /// Called before a trial of length `dt` [s] after `reductions` in a row; says whether it has changed the state.
    pub(crate) fn prepare(
        &mut self,
        model: &NaturalModel<T, D>,
        dt: T,
        reductions: u32,
        state: &mut State<T>,
    ) -> bool {
        let step = (dt, model.length());
        match self {
            Self::Augmented { index: Index::Both(change), workspace, .. } => {
                change.prepare(model, step, reductions, state, workspace)
            }
            _ => false,
        }
    }

    /// A trial of length `dt` [s] has come to its end.
    pub(crate) fn tried(&mut self, dt: T) {
        if let Self::Augmented { index: Index::Both(change), .. } = self {
            change.tried(dt);
        }
    }

    /// The last trial is the step.
    pub(crate) fn accept(&mut self) {
        if let Self::Augmented { index: Index::Both(change), .. } = self {
            change.keep();
        }
    }

    /// Keeps what stands beside the natural state, so that steps after it can be undone.
    pub(crate) fn keep(&mut self) {
        match self {
            Self::Augmented { workspace, .. } => workspace.keep(),
            Self::Recursive(tree) => tree.keep(),
            _ => {}
        }
    }

    /// Goes back to what was kept; the natural state is the caller's.
    pub(crate) fn undo(&mut self) {
        match self {
            Self::Augmented { workspace, .. } => workspace.undo(),
            Self::Recursive(tree) => tree.undo(),
            _ => {}
        }
    }

    /// The index in which the next step would be made, and the changes of it so far; nothing where there is none.
    pub(crate) fn index(&self) -> Option<(u8, u32)> {
        let Self::Augmented { index, .. } = self else { return None };
        Some(match index {
            Index::One(_) => (1, 0),
            Index::Three(_) => (3, 0),
            Index::Both(change) => {
                let is_one = change.index() == mbs_augmented::ConstraintIndex::One;
                (if is_one { 1 } else { 3 }, change.changes())
            }
        })
    }

    /// Sets the clock of a state that is not the natural one.
    pub(crate) fn set_time(&mut self, t: T) {
        if let Self::Recursive(tree) = self {
            tree.set_time(t);
        }
    }

    /// Kinetic and potential energy at the start [J].
    pub(crate) fn start_energies(&self, model: &NaturalModel<T, D>, s: &State<T>) -> [f64; 2] {
        if let Self::Recursive(tree) = self {
            return tree.energies();
        }
        let mut terms = model.terms();
        model.set_inputs(s.t, s, &mut terms);
        model.evaluate(&s.q, &mut terms);
        model.evaluate_forces(&s.q, &s.v, &mut terms);
        [model.kinetic_energy(&s.v).to_f64(), model.potential_energy(&s.q, &terms).to_f64()]
    }

    /// Takes the energies anew where they are kept from the last step.
    pub(crate) fn watch(&mut self) {
        if let Self::Recursive(tree) = self {
            tree.watch();
        }
    }

    /// Kinetic and potential energy and the work so far [J].
    pub(crate) fn energies(&self, model: &NaturalModel<T, D>, s: &State<T>) -> [f64; 3] {
        let work = s.work.to_f64();
        let Some(terms) = self.terms() else {
            let [kinetic, potential] = self.start_energies(model, s);
            return [kinetic, potential, work];
        };
        if let Self::Augmented { team, .. } | Self::Classical { team, .. } = self {
            let model = model.with_team(team);
            let potential = model.potential_energy(&s.q, terms);
            return [model.kinetic_energy(&s.v).to_f64(), potential.to_f64(), work];
        }
        let kinetic = model.kinetic_energy(&s.v).to_f64();
        [kinetic, model.potential_energy(&s.q, terms).to_f64(), work]
    }

    /// The terms of the natural-coordinate model as last evaluated.
    fn terms(&self) -> Option<&Terms<T>> {
        match self {
            Self::Augmented { workspace, .. } => Some(workspace.terms()),
            Self::Classical { workspace, .. } => Some(workspace.terms()),
            Self::StateSpace { workspace, .. } => Some(workspace.terms()),
            Self::Recursive(_) => None,
        }
    }

    /// Coordinates, constraints and their rank at the start; nothing in natural coordinates, which are the same for all.
    pub(crate) fn sizes(&self) -> Option<[usize; 3]> {
        match self {
            Self::Recursive(tree) => Some(tree.sizes()),
            _ => None,
        }
    }

    /// Threads that share the work of a step, this one among them.
    pub(crate) fn threads(&self) -> usize {
        match self {
            Self::Augmented { team, .. } | Self::Classical { team, .. } => team.size(),
            Self::StateSpace { .. } | Self::Recursive(_) => 1,
        }
    }

    /// What an unknown of the formulation belongs to.
    pub(crate) fn owner_of_unknown(&self, model: &NaturalModel<T, D>, u: usize) -> Owner {
        match self {
            Self::Recursive(tree) => tree.owner_of_unknown(u),
            // The classical Lagrangian's unknowns are coordinates, then multipliers.
            Self::Classical { .. } if u >= model.n_unknowns() => {
                model.owner_of_row(u - model.n_unknowns())
            }
            _ => model.owner_of_unknown(u),
        }
    }

    /// What a constraint row of the formulation belongs to.
    pub(crate) fn owner_of_row(&self, model: &NaturalModel<T, D>, row: usize) -> Owner {
        match self {
            Self::Recursive(tree) => tree.owner_of_row(row),
            _ => model.owner_of_row(row),
        }
    }
}

/// The threads that are asked for, as far as they find work: a step has so many branches, and threads wait awake for their turn.
fn team(settings: &Settings, branches: usize) -> Result<Threads, StopError> {
    let n = settings.threads.min(most_threads()).min(branches.max(1));
    Threads::new(n).map_err(|_| StopError::NoThreads(n))
}

/// Options of index-1 and index-3.
fn augmented_options<T: Real>(settings: &Settings) -> [mbs_augmented::Options<T>; 2] {
    use mbs_augmented::Options;
    // One number cannot be kg and N/m: of both indices it is that of index-3.
    let is_for = |is_index1: bool| !is_index1 || settings.formulation == FormulationKind::Index1;
    [(Options::index1(), true), (Options::index3(), false)].map(|(mut options, is_index1)| {
        options.integrator = settings.integrator.coefficients();
        if let Some(alpha) = settings.penalty.filter(|_| is_for(is_index1)) {
            options.penalty = Penalty::Fixed(T::from_f64(alpha));
            options.adaptive_penalty = false;
        }
        if let Some(tolerance) = settings.tolerance {
            (options.tolerance, options.share) = (T::from_f64(tolerance), T::ZERO);
        }
        options
    })
}

fn classical_options<T: Real>(settings: &Settings) -> classical::Options<T> {
    let mut options = classical::Options {
        integrator: settings.integrator.coefficients(),
        ..classical::Options::index3()
    };
    if let Some(alpha) = settings.penalty {
        options.regularisation = Some(T::ONE / T::from_f64(alpha));
    }
    if let Some(tolerance) = settings.tolerance {
        options.tolerance = T::from_f64(tolerance);
    }
    options
}
