//! Assembled scene, the starting point of every simulation and analysis.

use crate::equilibrium::{Search, equilibrium_start};
use crate::rest::without_rates;
use crate::stop::StopError;
use crate::tilt;
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::once::{find, found};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_core::start::{Assembled, assemble, start_at};
use mbs_core::{Cliques, Real, instances};
use mbs_linear::Equilibrium;
use mbs_sparse::Multifrontal;

/// A model, its linear solver, and its consistent start.
#[derive(Debug)]
pub struct AssembledScene<T: Real, const D: usize> {
    /// Model in natural coordinates.
    pub model: NaturalModel<T, D>,
    /// Linear solver of the assembly.
    pub solver: Multifrontal<T>,
    /// Consistent start of the model.
    pub start: Assembled<T>,
    rank: Option<usize>,
    parts: Parts<T, D>,
}

/// Functions that are compiled in this crate and stored here for callers with an assembled scene.
#[derive(Debug, Clone, Copy)]
struct Parts<T: Real, const D: usize> {
    rank: Rank<T, D>,
    clone: fn(&AssembledScene<T, D>) -> AssembledScene<T, D>,
}

impl<T: Real, const D: usize> Parts<T, D> {
    fn new() -> Self {
        Self { rank, clone: AssembledScene::clone_here }
    }
}

impl<T: Real, const D: usize> Clone for AssembledScene<T, D> {
    fn clone(&self) -> Self {
        (self.parts.clone)(self)
    }
}

type Assemble<T, const D: usize> = fn(&Scene<T>) -> Result<AssembledScene<T, D>, StopError>;
type Settle<T, const D: usize> =
    fn(&Scene<T>, Search) -> Result<(AssembledScene<T, D>, Equilibrium<T>), StopError>;
type Rank<T, const D: usize> = fn(&NaturalModel<T, D>, &State<T>) -> usize;
instances!(ASSEMBLE: Assemble<T, D> = assemble_scene::<T, D>);
instances!(SETTLE: Settle<T, D> = settle_scene::<T, D>);

impl<T: Real, const D: usize> AssembledScene<T, D> {
    /// Builds the model of a scene and assembles it. If the scene requests an equilibrium as its start, the equilibrium is searched.
    ///
    /// # Errors
    /// [`StopError`] when there is no model, no consistent start or no equilibrium.
    pub fn new(scene: &Scene<T>) -> Result<Self, StopError> {
        match Search::of_start(scene.start) {
            Some(search) => Ok(Self::settled(scene, search)?.0),
            None => Self::assembled(scene),
        }
    }

    /// Builds the model of a scene, and starts at a static equilibrium with the scene's initial velocities.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn settled(scene: &Scene<T>, search: Search) -> Result<(Self, Equilibrium<T>), StopError> {
        find::<Settle<T, D>>(SETTLE).ok_or(StopError::NotBuilt)?(scene, search)
    }

    /// Builds the model of a scene and assembles it, without a search for an equilibrium.
    ///
    /// # Errors
    /// [`StopError::Start`] when there is no model or no consistent start, [`StopError::AlmostDependent`] for an axis whose tilt locks a
    /// loop.
    pub fn assembled(scene: &Scene<T>) -> Result<Self, StopError> {
        find::<Assemble<T, D>>(ASSEMBLE).ok_or(StopError::NotBuilt)?(scene)
    }

    /// Builds the model of a scene whose bodies move as given by `motions` at time `t` [s]: see [`start_at`].
    ///
    /// # Errors
    /// [`StopError::Start`] if the model cannot be built, or the accelerations cannot be computed.
    pub fn placed(
        scene: &Scene<T>,
        (t, motions): (T, &[RigidMotion<T>]),
    ) -> Result<Self, StopError> {
        let scene = &*tilt::meant::<T, D>(scene).0;
        let model = NaturalModel::new(scene).map_err(|e| StopError::Start(e.into()))?;
        let mut solver = Multifrontal::analyse(&model, mbs_sparse::Options::default());
        let start = start_at((scene, &model), &mut solver, (t, motions));
        let start = start.map_err(|error| StopError::Start(error).or_law(model.codes()))?;
        Ok(Self { start, model, solver, rank: None, parts: Parts::new() })
    }

    /// Number of coordinates, number of constraints, and their rank at the start; the rank is computed once.
    pub fn sizes(&mut self) -> [usize; 3] {
        let Self { model, start, rank: known, parts, .. } = self;
        let rank = *known.get_or_insert_with(|| (parts.rank)(model, &start.state));
        [model.n_unknowns(), model.n_constraints(), rank]
    }

    fn clone_here(&self) -> Self {
        let Self { model, solver, start, rank, parts } = self;
        let (model, solver, start) = (model.clone(), solver.clone(), start.clone());
        Self { model, solver, start, rank: *rank, parts: *parts }
    }
}

fn assemble_scene<T: Real, const D: usize>(
    scene: &Scene<T>,
) -> Result<AssembledScene<T, D>, StopError> {
    let (scene, locks) = tilt::meant::<T, D>(scene);
    let scene = &*scene;
    let model = NaturalModel::new(scene).map_err(|e| StopError::Start(e.into()))?;
    if let Some(tilt) = tilt::lock::<T, D>(scene, &locks) {
        return Err(StopError::AlmostDependent(tilt));
    }
    let analyse = mbs_sparse::Options::default();
    let mut solver = Multifrontal::analyse(&model, analyse);
    let start = assemble(scene, &model, |p| Multifrontal::analyse(p, analyse), &mut solver);
    let start = start.map_err(|error| StopError::Start(error).or_law(model.codes()))?;
    Ok(AssembledScene { start, model, solver, rank: None, parts: Parts::new() })
}

fn settle_scene<T: Real, const D: usize>(
    scene: &Scene<T>,
    search: Search,
) -> Result<(AssembledScene<T, D>, Equilibrium<T>), StopError> {
    let mut ready = assemble_scene(&without_rates(scene.clone()))?;
    let AssembledScene { model, solver, start, .. } = &mut ready;
    let found = equilibrium_start(scene, model, search, solver, start)?;
    Ok((ready, found))
}

/// Computes [`rank`] in `f64`, compiled in this crate.
pub fn constraint_rank<const D: usize>(model: &NaturalModel<f64, D>, state: &State<f64>) -> usize {
    found::<Rank<f64, D>>(RANK)(model, state)
}

instances!(f64 RANK: Rank<f64, D> = rank::<f64, D>);

/// Rank of the constraints at a state.
pub fn rank<T: Real, const D: usize>(model: &NaturalModel<T, D>, state: &State<T>) -> usize {
    let mut terms = model.terms();
    model.set_inputs(state.t, state, &mut terms);
    model.evaluate(&state.q, &mut terms);
    mbs_core::start::constraint_rank(model, &terms)
}
