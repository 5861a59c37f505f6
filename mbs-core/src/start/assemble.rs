//! The three levels, one after the other, and what the first two share: sweeps of the augmented Lagrangian in correction form.
//!
//! ```text
//! W d = M (x - x*) + J^T (sigma + S phi),   x <- x - d,   sigma <- sigma + S (phi - J d)
//! ```
//!
//! The multipliers grow by what d is in balance with, not by S phi after it, which has the square of d in it.

use super::accelerations::accelerations;
use super::error::AssemblyError;
use super::hold::StartRow;
use super::problem::{Level, Problem, Sweep};
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::{Cliques, SpdSolver};
use crate::model::{Model, Owner, State};
use crate::natural::NaturalModel;
use crate::scene::Scene;
use alloc::vec;
use alloc::vec::Vec;

/// A consistent state, and what was done to get it.
#[derive(Debug, Clone, PartialEq)]
pub struct Assembled<T> {
    /// The state: positions, velocities, accelerations and multipliers satisfy everything.
    pub state: State<T>,
    /// Largest change of a coordinate from the reference configuration [m or -].
    pub change: T,
    /// Largest residual of joints and held values before any change [m or rad].
    pub residual_before: T,
    /// Largest residuals after: position, velocity, acceleration.
    pub residual: [T; 3],
    /// Continuation stages taken.
    pub stages: u32,
}

/// Most sweeps at each level and stage [-]. Chosen, not tuned.
pub(super) const MAX_SWEEPS: u32 = 60;
/// Factor on all penalties after a slow sweep [-], as some combinations of rows are weakly determined in long chains of light links. Two raises
/// make 1e9 effective masses of 1e6.
pub(super) const RAISE: f64 = 30.0;
/// Ratio of residuals after and before a sweep above which it is slow [-]. Chosen, not tuned.
pub(super) const SLOW_RATIO: f64 = 0.3;
/// Residual of a row that is accepted, in units of rounding of its numbers [-]: what evaluation and solution leave. Chosen, not tuned.
const ROUNDINGS: f64 = 256.0;
/// Ratio within which a held row is named in place of the row with the largest residual [-]. Chosen, not tuned.
const NAMED_RATIO: f64 = 10.0;

/// Assembles a scene: `make_start` analyses a solver for the start problem, `solver` is analysed for the model.
///
/// # Errors
/// [`AssemblyError`] says which joint or entry cannot be met.
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

/// Velocities and accelerations at positions that are given, as [`assemble`] makes them: those that the scene holds, else the
/// smallest. `state.q` must meet the constraints, with guides at their values of time zero; held positions are not asked for.
/// Returns the largest residuals of position, velocity and acceleration.
///
/// # Errors
/// [`AssemblyError`] says which joint or entry cannot be met.
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

pub(super) struct Assembly<'a, T: Real, S, const D: usize> {
    pub(super) problem: Problem<'a, T, D>,
    pub(super) solver: S,
    pub(super) guides: Vec<[T; 3]>,
    pub(super) reference: Vec<T>,
    /// Right-hand side, then the correction; extended, zero in the constants.
    pub(super) f: Vec<T>,
    pub(super) scratch: Vec<T>,
    /// x - x*, extended.
    pub(super) change: Vec<T>,
    pub(super) sigma: Vec<T>,
    pub(super) mu: Vec<T>,
    /// Residuals of all rows: the model's, then the holds'.
    pub(super) rows: Vec<T>,
    pub(super) products: Vec<T>,
    pub(super) length: T,
}

impl<'a, T: Real, S: SpdSolver<T>, const D: usize> Assembly<'a, T, S, D> {
    fn new(mut problem: Problem<'a, T, D>, solver: S, start: &State<T>) -> Self {
        let model = problem.model;
        let rows = model.n_constraints() + problem.holds.len();
        model.set_inputs(T::ZERO, start, &mut problem.terms);
        let zeros = |k| vec![T::ZERO; k];
        let mut reference = zeros(model.n_extended());
        model.write_reference(&mut reference);
        Self {
            guides: problem.terms.guides.clone(),
            reference,
            f: zeros(model.n_extended()),
            scratch: zeros(solver.n_scratch()),
            solver,
            change: zeros(model.n_extended()),
            sigma: zeros(rows),
            mu: zeros(rows),
            rows: zeros(rows),
            products: zeros(rows),
            length: model.length(),
            problem,
        }
    }

    /// Rows at `q` with holds and guides at the share `tau` of their initial values, as if they had been driven there.
    pub(super) fn drive(&mut self, q: &[T], tau: T) {
        for (value, full) in self.problem.terms.guides.iter_mut().zip(&self.guides) {
            *value = [full[0] * tau, full[1], full[2]];
        }
        let p = &mut self.problem;
        p.evaluate(q, tau);
        let (rows, holds) = self.rows.split_at_mut(p.terms.phi.len());
        rows.copy_from_slice(&p.terms.phi);
        holds.copy_from_slice(&p.residuals);
    }

    /// f = W^-1 (M change + J^T mu), of the matrix as last factored.
    pub(super) fn solve(&mut self, level: Level) {
        self.pull(level);
        let n = self.problem.n_unknowns();
        self.solver.solve(&mut self.f[..n], &mut self.scratch);
    }

    /// f = M change + J^T mu.
    pub(super) fn pull(&mut self, level: Level) {
        let n = self.problem.n_unknowns();
        let system = Sweep {
            problem: &self.problem,
            level,
            change: &self.change,
            multipliers: &self.mu,
            curvature: None,
            damping: T::ZERO,
        };
        self.solver.assemble(&system, &mut self.f[..n]);
    }

    /// Factors W, with the curvature of the rows at `curved` and some damping.
    pub(super) fn factor(
        &mut self,
        level: Level,
        curved: Option<&[T]>,
        damping: T,
    ) -> Result<(), AssemblyError> {
        let system = Sweep {
            problem: &self.problem,
            level,
            change: &self.change,
            multipliers: &self.mu,
            curvature: curved.map(|q| (q, &self.sigma[..])),
            damping,
        };
        self.solver.factor(&system).map_err(|e| AssemblyError::NoInertia {
            owner: self.problem.model.owner_of_unknown(e.unknown as usize),
        })
    }

    /// mu = sigma + S phi.
    pub(super) fn load(&mut self) {
        for (k, &p) in self.problem.penalty.iter().enumerate() {
            self.mu[k] = self.sigma[k] + p * self.rows[k];
        }
    }

    /// sigma <- sigma + S (phi - J d).
    pub(super) fn grow(&mut self, level: Level) {
        self.problem.multiply(&self.f, level, &mut self.products);
        for (k, &p) in self.problem.penalty.iter().enumerate() {
            self.sigma[k] += p * (self.rows[k] - self.products[k]);
        }
    }

    /// The largest coordinate of a correction or velocity, each relative to its size.
    pub(super) fn largest(&self, x: &[T]) -> T {
        self.problem.sizes.iter().zip(x).fold(T::ZERO, |s, (&size, &x)| s.max(x.abs() / size))
    }

    /// The largest of `rows`, each relative to its spread.
    pub(super) fn worst(&self, rows: &[T]) -> T {
        let rows = self.problem.spreads.iter().zip(rows);
        rows.fold(T::ZERO, |s, (&spread, &x)| s.max(x.abs() / spread))
    }

    /// A rounding of rows at `q`, relative to their spreads: places far from the origin have fewer digits left.
    pub(super) fn rounding(&self, q: &[T]) -> T {
        T::EPSILON * self.largest(q).max(T::ONE)
    }

    /// What is accepted of a row, relative to its spread.
    pub(super) fn accepted(&self, q: &[T]) -> T {
        self.rounding(q) * T::from_f64(ROUNDINGS)
    }

    pub(super) fn largest_position(&self) -> T {
        norm_inf(&[norm_inf(&self.problem.terms.phi), norm_inf(&self.problem.residuals)])
    }

    /// Where the largest residual is: its size, whose it is, and the entry if it is a held row.
    pub(super) fn culprit(&self) -> (T, Owner, Option<usize>) {
        let p = &self.problem;
        let (rows, holds) = self.rows.split_at(p.model.n_constraints());
        let (near, far) = p.spreads.split_at(rows.len());
        let largest = |x: &[T], spreads: &[T]| {
            let size = |i: usize| x[i].abs() / spreads[i];
            let order = |i: &usize, j: &usize| {
                size(*i).partial_cmp(&size(*j)).unwrap_or(core::cmp::Ordering::Equal)
            };
            (0..x.len()).max_by(order).map(|i| (i, size(i)))
        };
        let (row, hold) = (largest(rows, near), largest(holds, far));
        match (row, hold) {
            // A held row near the largest residual is what the user wrote: name that.
            (row, Some((h, size)))
                if row.is_none_or(|(_, other)| size * T::from_f64(NAMED_RATIO) >= other) =>
            {
                (holds[h].abs(), p.holds[h].owner, Some(p.holds[h].initial))
            }
            (row, _) => {
                let row = row.map_or(0, |(row, _)| row);
                (rows.get(row).map_or(T::ZERO, |x| x.abs()), p.model.owner_of_row(row), None)
            }
        }
    }
}

/// How often penalties may be raised: in double precision to 1e9 effective masses, in single precision to 15,000.
pub(super) fn raises<T: Real>() -> u32 {
    if super::problem::is_fine::<T>() { 2 } else { 1 }
}
