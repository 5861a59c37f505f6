//! Sweeps of the augmented Lagrangian method in correction form, for positions and velocities.
//!
//! ```text
//! W d = M (x - x*) + J^T (sigma + S phi),   x <- x - d,   sigma <- sigma + S (phi - J d)
//! ```
//!
//! W is the matrix of the start problem, S the penalties, sigma the multipliers, x* the reference. The multipliers change by the value that
//! balances the correction d. S phi after the correction would contain an error of order d^2.

use super::error::AssemblyError;
use super::problem::{Level, Problem, Sweep};
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::{Cliques, SpdSolver};
use crate::model::{Model, Owner, State};
use alloc::vec;
use alloc::vec::Vec;

/// Accepted residual of a row, in multiples of the machine precision of its terms [-]. It allows for rounding errors in the evaluation of
/// the row and in its correction.
const ROUNDINGS: f64 = 256.0;

pub(super) struct Assembly<'a, T: Real, S, const D: usize> {
    pub(super) problem: Problem<'a, T, D>,
    pub(super) solver: S,
    pub(super) guides: Vec<[T; 3]>,
    pub(super) reference: Vec<T>,
    /// Right-hand side, then the correction; over all coordinates, zero in the constants.
    pub(super) f: Vec<T>,
    pub(super) scratch: Vec<T>,
    /// Change x - x*, over all coordinates.
    pub(super) change: Vec<T>,
    pub(super) sigma: Vec<T>,
    pub(super) mu: Vec<T>,
    /// Residuals of all rows: the model's rows, then the start rows.
    pub(super) rows: Vec<T>,
    pub(super) products: Vec<T>,
    pub(super) length: T,
    /// Places and values of the remembered angles that the scene determines.
    pub(super) turns: Vec<(usize, T)>,
}

impl<'a, T: Real, S: SpdSolver<T>, const D: usize> Assembly<'a, T, S, D> {
    pub(super) fn new(mut problem: Problem<'a, T, D>, solver: S, start: &State<T>) -> Self {
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
            turns: Vec::new(),
            problem,
        }
    }

    /// Evaluates the rows at `q`, with prescribed values and guides at the fraction `tau` of their values.
    pub(super) fn drive(&mut self, q: &[T], tau: T) {
        for (value, full) in self.problem.terms.guides.iter_mut().zip(&self.guides) {
            *value = [full[0] * tau, full[1], full[2]];
        }
        for &(place, angle) in &self.turns {
            self.problem.terms.angles[place] = angle * tau;
        }
        let p = &mut self.problem;
        p.evaluate(q, tau);
        let (rows, holds) = self.rows.split_at_mut(p.terms.phi.len());
        rows.copy_from_slice(&p.terms.phi);
        holds.copy_from_slice(&p.residuals);
    }

    /// Computes f = W^-1 (M change + J^T mu), with the last factor of W.
    pub(super) fn solve(&mut self, level: Level) {
        self.pull(level);
        let n = self.problem.n_unknowns();
        self.solver.solve(&mut self.f[..n], &mut self.scratch);
    }

    /// Computes f = M change + J^T mu.
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

    /// Factors W, with the curvature of the rows at `curved` and with damping.
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

    /// Computes mu = sigma + S phi.
    pub(super) fn load(&mut self) {
        for (k, &p) in self.problem.penalty.iter().enumerate() {
            self.mu[k] = self.sigma[k] + p * self.rows[k];
        }
    }

    /// Updates the multipliers: sigma <- sigma + S (phi - J d).
    pub(super) fn grow(&mut self, level: Level) {
        self.problem.multiply(&self.f, level, &mut self.products);
        for (k, &p) in self.problem.penalty.iter().enumerate() {
            self.sigma[k] += p * (self.rows[k] - self.products[k]);
        }
    }

    /// Largest component of a correction or velocity, relative to the sizes of the coordinates.
    pub(super) fn largest(&self, x: &[T]) -> T {
        self.problem.sizes.iter().zip(x).fold(T::ZERO, |s, (&size, &x)| s.max(x.abs() / size))
    }

    /// Largest of `rows`, relative to the spreads of the rows.
    pub(super) fn worst(&self, rows: &[T]) -> T {
        let rows = self.problem.spreads.iter().zip(rows);
        rows.fold(T::ZERO, |s, (&spread, &x)| s.max(x.abs() / spread))
    }

    /// Rounding error of rows at `q`, relative to their spreads. It grows with the distance of `q` from the origin.
    pub(super) fn rounding(&self, q: &[T]) -> T {
        T::EPSILON * self.largest(q).max(T::ONE)
    }

    /// Accepted residual of a row, relative to its spread.
    pub(super) fn accepted(&self, q: &[T]) -> T {
        self.rounding(q) * T::from_f64(ROUNDINGS)
    }

    pub(super) fn largest_position(&self) -> T {
        norm_inf(&[norm_inf(&self.problem.terms.phi), norm_inf(&self.problem.residuals)])
    }

    /// Row with the largest residual: the residual, its owner, and the index of the `[[initial]]` entry for a start row.
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
            // Report a start row if its residual is within a factor of ten of the largest one, since the user wrote it.
            (row, Some((h, size)))
                if row.is_none_or(|(_, other)| size * T::from_f64(10.0) >= other) =>
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
