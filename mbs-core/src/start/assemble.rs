//! Assembly of a consistent state: its three levels, one after the other.

use super::accelerations::accelerations;
use super::error::AssemblyError;
use super::hold::StartRow;
use super::positions::{given_turns, remember_given};
use super::problem::Problem;
use super::sweeps::Assembly;
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::SpdSolver;
use crate::mechanism::Scene;
use crate::model::{Model, State};
use crate::natural::NaturalModel;
use crate::rigid::RigidMotion;

/// A consistent state, with a summary of its assembly.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled<T> {
    /// State of the scene. Its positions, velocities, accelerations and multipliers satisfy all equations.
    pub state: State<T>,
    /// Largest change of a coordinate from the reference configuration [m or -].
    pub change: T,
    /// Largest residual of joints and of prescribed start values before any change [m or rad].
    pub residual_before: T,
    /// Largest residuals of the result: position, velocity, acceleration.
    pub residual: [T; 3],
    /// Number of continuation stages.
    pub stages: u32,
}

/// Assembles a scene at time zero. `make_start` creates a solver that is analysed for the start problem. `solver` is analysed for the model.
///
/// # Errors
/// [`AssemblyError`] with the joint or entry that cannot be satisfied.
pub fn assemble<T: Real, const D: usize, S: SpdSolver<T>>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    make_start: impl FnOnce(&Problem<'_, T, D>) -> S,
    solver: &mut impl SpdSolver<T>,
) -> Result<Assembled<T>, AssemblyError> {
    let mut state = State::at_rest(model);
    let problem = Problem::new(model, StartRow::all(scene, model));
    let start_solver = make_start(&problem);
    let mut assembly = Assembly::new(problem, start_solver, &state);
    let (residual_before, stages) = assembly.positions(scene, &mut state)?;
    assembly.count_turns(scene, &mut state);
    let position = assembly.largest_position();
    assembly.velocities(&mut state)?;
    let velocity = norm_inf(&assembly.rows);
    let change =
        assembly.reference.iter().zip(&state.q).fold(T::ZERO, |c, (&r, &q)| c.max((q - r).abs()));
    let mut terms = assembly.problem.terms;
    let acceleration = accelerations(model, solver, &mut state, &mut terms)?;
    let residual = [position, velocity, acceleration];
    Ok(Assembled { state, change, residual_before, residual, stages })
}

/// Computes velocities and accelerations at given positions, by the same rules as [`assemble`]. Velocities satisfy the rates that the scene
/// prescribes, and are otherwise as small as possible. `state.q` must satisfy the constraints, with guides at their values of time zero;
/// prescribed start positions are ignored. Returns the largest residuals of position, velocity and acceleration.
///
/// # Errors
/// [`AssemblyError`] with the joint or entry that cannot be satisfied.
pub fn restart<T: Real, const D: usize, S: SpdSolver<T>>(
    scene: &Scene<T>,
    model: &NaturalModel<T, D>,
    make_start: impl FnOnce(&Problem<'_, T, D>) -> S,
    solver: &mut impl SpdSolver<T>,
    state: &mut State<T>,
) -> Result<[T; 3], AssemblyError> {
    let problem = Problem::new(model, StartRow::all(scene, model));
    let start_solver = make_start(&problem);
    let mut assembly = Assembly::new(problem, start_solver, state);
    assembly.drive(&state.q, T::ONE);
    let position = norm_inf(&assembly.problem.terms.phi);
    state.v.fill(T::ZERO);
    assembly.velocities(state)?;
    let velocity = norm_inf(&assembly.rows);
    let mut terms = assembly.problem.terms;
    Ok([position, velocity, accelerations(model, solver, state, &mut terms)?])
}

/// State of a scene at time `t` from given motions of its bodies, which must satisfy the constraints. Positions and velocities are as
/// given; accelerations and multipliers are computed. Angles begin with the turns that are nearest to the scene's initial values.
///
/// # Errors
/// [`AssemblyError`] if no accelerations are found.
pub fn start_at<T: Real, const D: usize>(
    (scene, model): (&Scene<T>, &NaturalModel<T, D>),
    solver: &mut impl SpdSolver<T>,
    (t, motions): (T, &[RigidMotion<T>]),
) -> Result<Assembled<T>, AssemblyError> {
    let mut state = State { t, ..State::at_rest(model) };
    remember_given(scene, model, &given_turns(scene, model), &mut state);
    let mut terms = model.terms();
    let reference = state.q.clone();
    model.take_motions(motions, &mut terms, &mut state);
    let acceleration = accelerations(model, solver, &mut state, &mut terms)?;
    let mut rates = terms.phi_t.clone();
    model.multiply_jacobian(&terms, &state.v, &mut rates);
    rates.iter_mut().zip(&terms.phi_t).for_each(|(rate, &phi_t)| *rate += phi_t);
    let residual = [norm_inf(&terms.phi), norm_inf(&rates), acceleration];
    let change = reference.iter().zip(&state.q).fold(T::ZERO, |c, (&r, &q)| c.max((q - r).abs()));
    Ok(Assembled { state, change, residual_before: residual[0], residual, stages: 0 })
}
