//! Static equilibrium as the start of a run.

use crate::rest::at_rest;
use crate::stop::StopError;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{Scene, Start};
use mbs_core::start::{Assembled, restart};
use mbs_core::{Cliques, Real, SpdSolver};
use mbs_linear::{
    Equilibrium, Options, Saddle, Workspace, equilibrium, equilibrium_near, rest_signals,
};
use mbs_sparse::{Indefinite, Multifrontal};

/// Returns the workspace for a static or linear analysis of a model.
pub fn workspace<T: Real, const D: usize>(
    model: &NaturalModel<T, D>,
) -> Workspace<T, Indefinite<T>> {
    let solver = Indefinite::analyse(&Saddle::new(model), mbs_sparse::Options::default());
    Workspace::new(model, solver)
}

mbs_core::named! {
    /// Method of the search for an equilibrium.
    #[derive(Default)]
    pub enum Search {
        /// Descent of the potential energy from the start, to a stable equilibrium.
        #[default]
        Down = "down",
        /// Newton's method from the start, to the nearest equilibrium, stable or unstable.
        Near = "near",
    }
}

impl Search {
    /// Returns the search that a scene with this start requests; `None` if the scene starts from its initial conditions.
    #[must_use]
    pub fn of_start(start: Start) -> Option<Self> {
        match start {
            Start::Initial => None,
            Start::Equilibrium => Some(Self::Down),
            Start::EquilibriumNear => Some(Self::Near),
        }
    }

    /// Returns the start of a scene that requests this search.
    #[must_use]
    pub fn start(self) -> Start {
        match self {
            Self::Down => Start::Equilibrium,
            Self::Near => Start::EquilibriumNear,
        }
    }
}

/// Moves a state to a static equilibrium, at rest and with guides at their initial values. Effects that act only in motion are omitted:
/// drives, drag, dry friction, and the forces of a rolling tire.
///
/// # Errors
/// [`StopError::Equilibrium`]; the positions are unchanged then.
pub fn find_equilibrium<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    search: Search,
    state: &mut State<T>,
) -> Result<Equilibrium<T>, StopError> {
    let still = at_rest(scene);
    if still == *scene {
        return settle_model(model, search, state);
    }
    let quiet = NaturalModel::<T, D>::new(&still).map_err(|e| StopError::Start(e.into()))?;
    let mut there = State::at_rest(&quiet);
    there.t = state.t;
    transfer((scene, model), state, &quiet, &mut there);
    let found = settle_model(&quiet, search, &mut there)?;
    transfer((&still, &quiet), &there, model, state);
    Ok(found)
}

/// Copies a state of one model to another model with the same bodies and joints.
fn transfer<T: Real, const D: usize>(
    (scene, from): (&Scene<T>, &NaturalModel<T, D>),
    state: &State<T>,
    to: &NaturalModel<T, D>,
    target: &mut State<T>,
) {
    let motions: Vec<_> = (0..scene.bodies.len()).map(|b| from.motion(scene, b, state)).collect();
    to.take_motions(&motions, &mut to.terms(), target);
    // Both models have the signals of the same scene, although their effects differ.
    if target.signals.len() == state.signals.len() {
        target.signals.copy_from_slice(&state.signals);
    }
}

fn settle_model<T: Real, const D: usize>(
    model: &NaturalModel<T, D>,
    search: Search,
    state: &mut State<T>,
) -> Result<Equilibrium<T>, StopError> {
    state.v.fill(T::ZERO);
    let (options, mut workspace) = (Options::default(), workspace(model));
    let found = match search {
        Search::Down => equilibrium(model, &options, state, &mut workspace),
        Search::Near => equilibrium_near(model, &options, state, &mut workspace),
    };
    let found = found.and_then(|found| {
        rest_signals(model, &options, state, &mut workspace)?;
        Ok(found)
    });
    found.map_err(|error| {
        let n = model.n_unknowns();
        StopError::equilibrium(
            error,
            n,
            |u| model.owner_of_unknown(u),
            |row| model.owner_of_row(row),
        )
        .or_law(model.codes())
    })
}

/// Replaces the start of a scene by its static equilibrium. Positions are those of the equilibrium, with guides held. Velocities follow
/// from the scene's initial velocities, and accelerations from the equations of motion. The scene's initial positions only define where the
/// search begins.
///
/// # Errors
/// [`StopError`] if there is no equilibrium, or the initial velocities are inconsistent with it.
pub fn equilibrium_start<T: Real, const D: usize>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    search: Search,
    solver: &mut impl SpdSolver<T>,
    start: &mut Assembled<T>,
) -> Result<Equilibrium<T>, StopError> {
    let found = find_equilibrium(scene, model, search, &mut start.state)?;
    let analyse = mbs_sparse::Options::default();
    let state = &mut start.state;
    let residual = restart(scene, model, |p| Multifrontal::analyse(p, analyse), solver, state);
    start.residual = residual.map_err(|error| StopError::Start(error).or_law(model.codes()))?;
    let mut reference = vec![T::ZERO; model.n_extended()];
    model.write_reference(&mut reference);
    let changes = reference.iter().zip(&start.state.q).map(|(&r, &q)| (q - r).abs());
    start.change = changes.fold(T::ZERO, T::max);
    Ok(found)
}
