//! Table of the formulations, one row for each: its name, its abilities, and the function that builds it.
//!
//! All differences between formulations are in this table or in the formulation's crate. No other code distinguishes them.

use crate::choice::IntegratorKind;
use crate::stop::StopError;
use mbs_augmented::{Augmented, Form, IndexChange, Penalty};
use mbs_classical::Classical;
use mbs_core::Real;
use mbs_core::formulation::Formulation;
use mbs_core::model::State;
use mbs_core::natural::{ModelError, NaturalModel};
use mbs_core::scene::Scene;
use mbs_core::start::AssemblyError;
use mbs_core::step::OptionError;
use mbs_parallel::{Threads, most_threads};
use mbs_recursive::space::Space;
use mbs_recursive::{Closure, Planar, Spatial, StartError, Tree, TreeMethod, TreeModel};
use mbs_sparse::{Indefinite, Multifrontal};
use mbs_statespace::StateSpace;

/// Name and abilities of a formulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// Name of the formulation in scenes and on the command line.
    pub name: &'static str,
    /// Sentence that describes the formulation.
    pub sentence: &'static str,
    /// Meaning of the penalty setting for the formulation.
    pub penalty: PenaltyUse,
    /// True if several threads can work on one step.
    pub threads: bool,
    /// True if the formulation steps relative coordinates. Integrators for systems of first order need relative coordinates.
    pub relative: bool,
    /// True if the energy rule is its default step control. This is so for a formulation whose index depends on the step length.
    pub energy_rule: bool,
    /// True if the formulation accepts redundant constraints.
    pub redundant: bool,
    /// True if effects may be omitted while the formulation runs.
    pub switches: bool,
    /// Rank among the formulations that compute or check a reference solution, the best first; `None`: the formulation is not used for
    /// references.
    pub reference: Option<u8>,
}

/// Meaning of the penalty setting for a formulation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PenaltyUse {
    /// The formulation has no penalty.
    None,
    /// The caller may give a penalty. The penalty of a scene file is ignored, because it is intended for other formulations.
    OfCaller,
    /// The penalty of the scene file applies; it has this unit.
    OfScene(&'static str),
}

/// Default row; each row of the table differs from it in few fields.
const ROW: Row = Row {
    name: "",
    sentence: "",
    penalty: PenaltyUse::OfCaller,
    threads: false,
    relative: false,
    energy_rule: false,
    redundant: true,
    switches: false,
    reference: None,
};

/// Options of a run that a formulation must satisfy: integrator, penalty, tolerance, threads and step.
#[derive(Debug, Clone, Copy)]
pub struct Demands<T> {
    pub integrator: IntegratorKind,
    pub penalty: Option<f64>,
    pub tolerance: Option<f64>,
    pub threads: usize,
    /// Length of a step of the run; with step control, length of the first step [s].
    pub step: T,
}

/// Parts from which a formulation is built.
#[derive(Debug)]
pub struct Request<'a, T: Real, const D: usize> {
    pub scene: &'a Scene<T>,
    pub demands: Demands<T>,
    pub model: &'a NaturalModel<T, D>,
    /// Linear solver, analysed for the cliques of the model.
    pub solver: Multifrontal<T>,
    /// State at the start.
    pub state: &'a mut State<T>,
}

type Built<T, const D: usize> = Result<Box<dyn Formulation<T, D>>, StopError>;

macro_rules! formulations {
    ($($kind:ident = $name:literal, $sentence:literal, $build:path, { $($field:ident: $value:expr),* };)*) => {
        /// Formulations that can run.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum FormulationKind {
            $(#[doc = $sentence] $kind,)*
        }

        /// Names of the available formulations, in scenes and on the command line.
        pub const FORMULATIONS: [&str; FormulationKind::ALL.len() + 1] = ["auto", $($name),*];

        impl FormulationKind {
            /// All formulations, in the order of [`FORMULATIONS`] after `auto`.
            pub const ALL: [Self; [$($name),*].len()] = [$(Self::$kind),*];

            /// Returns the row of the formulation: name and abilities.
            #[must_use]
            pub fn row(self) -> Row {
                match self {
                    $(Self::$kind => Row { name: $name, sentence: $sentence, $($field: $value,)* ..ROW },)*
                }
            }

            /// Builds the formulation for a request.
            pub fn build<T: Real, const D: usize>(self, request: Request<'_, T, D>) -> Built<T, D> {
                match self {
                    $(Self::$kind => $build(request),)*
                }
            }
        }
    };
}

formulations! {
    Index1 = "index-1", "Index-1 augmented Lagrangian.", index1,
        { penalty: PenaltyUse::OfScene("kg"), threads: true, switches: true, reference: Some(4) };
    Index3 = "index-3", "Index-3 augmented Lagrangian.", index3,
        { penalty: PenaltyUse::OfScene("N/m"), threads: true, switches: true, reference: Some(1) };
    MultiIndex = "multi-index", "Augmented Lagrangian in index-3 for long steps and in index-1 for short ones.", multi_index,
        { penalty: PenaltyUse::OfScene("N/m"), threads: true, switches: true, energy_rule: true };
    Classical = "classical", "Index-3 classical Lagrangian.", classical,
        { threads: true, redundant: false, reference: Some(3) };
    StateSpace = "state-space", "State space: independent coordinates by a null-space basis.", state_space,
        { penalty: PenaltyUse::None, reference: Some(2) };
    Recursive = "recursive", "Fully recursive, relative coordinates.", recursive,
        { relative: true, switches: true, reference: Some(0) };
}

impl FormulationKind {
    /// Formulation that runs if none is requested. Comparisons use it as the basis.
    pub const DEFAULT: Self = Self::Index3;
    /// Formulation in relative coordinates.
    pub const RELATIVE: Self = Self::Recursive;

    /// Name of the formulation in scenes and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Returns the formulation with a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|f| f.name() == name)
    }

    /// All formulations in the order of tables: the default first.
    pub fn listed() -> impl Iterator<Item = Self> {
        let others = Self::ALL.into_iter().filter(|f| *f != Self::DEFAULT);
        core::iter::once(Self::DEFAULT).chain(others)
    }

    /// Formulations that compute and check a reference solution, the best first.
    #[must_use]
    pub fn references() -> Vec<Self> {
        let mut all: Vec<Self> = Self::listed().filter(|f| f.row().reference.is_some()).collect();
        all.sort_by_key(|f| f.row().reference);
        all
    }

    /// Names of the formulations with an ability, joined as in `index-3, index-1 or recursive`; `last` is the word before the last name.
    pub fn names(can: impl Fn(&Row) -> bool, last: &str) -> String {
        let names: Vec<_> = Self::listed().map(Self::row).filter(can).map(|row| row.name).collect();
        match &names[..] {
            [others @ .., end] if !others.is_empty() => {
                format!("{} {last} {end}", others.join(", "))
            }
            _ => names.concat(),
        }
    }

    /// Unit of the scene's penalty, if the formulation uses the scene's penalty.
    #[must_use]
    pub fn scene_penalty(self) -> Option<&'static str> {
        match self.row().penalty {
            PenaltyUse::OfScene(unit) => Some(unit),
            PenaltyUse::None | PenaltyUse::OfCaller => None,
        }
    }

    /// True if the formulation can run with this integrator.
    #[must_use]
    pub fn runs_with(self, integrator: IntegratorKind) -> bool {
        self.row().relative || !integrator.is_of_first_order()
    }
}

fn index1<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    let penalty = request.demands.penalty;
    let options = augmented_options(mbs_augmented::Options::index1(), &request.demands, penalty);
    augmented(Form::Index1(options), request)
}

fn index3<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    augmented(Form::Index3(options_of_index3(&request.demands)), request)
}

fn multi_index<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    // The penalties of index-1 and index-3 have different units, kg and N/m. The penalty of a scene applies to index-3.
    let one = augmented_options(mbs_augmented::Options::index1(), &request.demands, None);
    let three = options_of_index3(&request.demands);
    augmented(Form::MultiIndex(IndexChange::new(one, three)), request)
}

fn options_of_index3<T: Real>(demands: &Demands<T>) -> mbs_augmented::Options<T> {
    augmented_options(mbs_augmented::Options::index3(), demands, demands.penalty)
}

fn augmented_options<T: Real>(
    mut options: mbs_augmented::Options<T>,
    demands: &Demands<T>,
    penalty: Option<f64>,
) -> mbs_augmented::Options<T> {
    options.integrator = demands.integrator.coefficients();
    if let Some(alpha) = penalty {
        options.penalty = Penalty::Fixed(T::from_f64(alpha));
        options.adaptive_penalty = false;
    }
    if let Some(tolerance) = demands.tolerance {
        (options.tolerance, options.truncation_share) = (T::from_f64(tolerance), T::ZERO);
    }
    options
}

fn augmented<T: Real, const D: usize>(form: Form<T>, request: Request<'_, T, D>) -> Built<T, D> {
    let Request { demands, model, solver, .. } = request;
    let team = team(&demands, solver.n_branches())?;
    let solver = solver.with_team(team.clone());
    boxed(Augmented::new(model, form, solver, team))
}

fn classical<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    let Request { demands, model, .. } = request;
    let mut options = mbs_classical::Options {
        integrator: demands.integrator.coefficients(),
        ..mbs_classical::Options::index3()
    };
    if let Some(alpha) = demands.penalty {
        options.regularisation = Some(T::ONE / T::from_f64(alpha));
    }
    if let Some(tolerance) = demands.tolerance {
        options.tolerance = T::from_f64(tolerance);
    }
    let saddle = mbs_classical::Saddle::new(model);
    let solver = Indefinite::analyse(&saddle, mbs_sparse::Options::default());
    let team = team(&demands, solver.n_branches())?;
    let solver = solver.with_team(team.clone());
    boxed(Classical::new(model, options, solver, team))
}

fn state_space<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    let mut options = mbs_statespace::Options {
        integrator: request.demands.integrator.coefficients(),
        ..mbs_statespace::Options::default()
    };
    if let Some(tolerance) = request.demands.tolerance {
        options.tolerance = T::from_f64(tolerance);
    }
    boxed(StateSpace::new(request.model, options, request.state))
}

fn recursive<T: Real, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    if const { D == 2 } { tree::<T, Planar, D>(request) } else { tree::<T, Spatial, D>(request) }
}

fn tree<T: Real, S: Space<T>, const D: usize>(request: Request<'_, T, D>) -> Built<T, D> {
    let Request { scene, demands, model: natural, state, .. } = request;
    let model = TreeModel::<T, S>::new(scene).map_err(StopError::tree)?;
    let start = model.start(scene, natural, state).map_err(|e| not_started(e, &model))?;
    let method = (tree_options(&demands), tree_method(demands.integrator));
    boxed(Tree::new(scene, (model, start), method, (natural, state)))
}

/// Default tolerance of a step of the extrapolation method, in units of machine precision [-]. It is 2e-10 in double precision and 5e-26 in
/// double-double precision.
pub const ROUNDINGS: f64 = 1e6;

pub fn tree_options<T: Real>(demands: &Demands<T>) -> mbs_recursive::Options<T> {
    let first_step = Some(demands.step);
    let mut options = mbs_recursive::Options { first_step, ..mbs_recursive::Options::default() };
    if !demands.integrator.is_of_first_order() {
        options.integrator = demands.integrator.coefficients();
    }
    if let Some(alpha) = demands.penalty {
        let alpha = T::from_f64(alpha);
        options.closure = Closure::Report { alpha, omega: T::from_f64(10.0), mu: T::ONE };
    }
    if demands.integrator == IntegratorKind::Extrapolation {
        // A method of such high order is chosen for accuracy, so its default tolerance is close to machine precision.
        options.error = T::EPSILON * T::from_f64(ROUNDINGS);
    }
    if let Some(tolerance) = demands.tolerance {
        options.tolerance = T::from_f64(tolerance);
        options.error = options.tolerance;
    }
    options
}

pub fn tree_method(integrator: IntegratorKind) -> TreeMethod {
    match integrator {
        IntegratorKind::Rk4 => TreeMethod::Rk4,
        IntegratorKind::Rk54 => TreeMethod::Rk54,
        IntegratorKind::Rk853 => TreeMethod::Rk853,
        IntegratorKind::Extrapolation => TreeMethod::Extrapolation,
        IntegratorKind::Radau5 => TreeMethod::Radau5,
        IntegratorKind::Trapezoidal
        | IntegratorKind::Newmark
        | IntegratorKind::GeneralisedAlpha
        | IntegratorKind::Hht => TreeMethod::Trapezoidal,
    }
}

/// Returns the error of a tree that has no consistent start, with the part of the scene that the error concerns.
fn not_started<T: Real, S: Space<T>>(error: StartError, model: &TreeModel<T, S>) -> StopError {
    match error {
        StartError::Tree(error) => StopError::tree(error),
        StartError::Step(error) => {
            StopError::step(error, |u| model.owner_of_unknown(u), |row| model.owner_of_row(row))
        }
        _ => StopError::Start(AssemblyError::Model(ModelError::Dimension)),
    }
}

fn boxed<T: Real, const D: usize>(
    built: Result<impl Formulation<T, D> + 'static, OptionError>,
) -> Built<T, D> {
    match built {
        Ok(formulation) => Ok(Box::new(formulation)),
        Err(error) => Err(StopError::Step(error.into(), None)),
    }
}

/// Creates the thread team. It has the requested number of threads, but at most one for each branch of a step, because more threads would
/// only wait.
fn team<T>(demands: &Demands<T>, branches: usize) -> Result<Threads, StopError> {
    let n = demands.threads.min(most_threads()).min(branches.max(1));
    Threads::new(n).map_err(|_| StopError::NoThreads(n))
}
