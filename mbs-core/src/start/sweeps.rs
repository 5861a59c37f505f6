//! Sweeps of the augmented Lagrangian in correction form, which positions and velocities share.
//!
//! ```text
//! W d = M (x - x*) + J^T (sigma + S phi),   x <- x - d,   sigma <- sigma + S (phi - J d)
//! ```
//!
//! The multipliers grow by what d is in balance with, not by S phi after it, which has the square of d in it.

use super::error::AssemblyError;
use super::problem::{Level, Problem, Sweep};
use crate::Real;
use crate::algebra::norm_inf;
use crate::blocks::{Cliques, SpdSolver};
use crate::model::{Model, Owner, State};
use alloc::vec;
use alloc::vec::Vec;

/// Roundings of a row's own numbers that are accepted: what evaluating it and solving for its correction leave.
const ROUNDINGS: f64 = 256.0;

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
    /// Places and angles of turns that the scene gives.
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

    /// Rows at `q` with holds and guides at the share `tau` of their initial values, as if they had been driven there.
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

    /// Residual of a row that is accepted, relative to its spread.
    pub(super) fn accepted(&self, q: &[T]) -> T {
        self.rounding(q) * T::from_f64(ROUNDINGS)
    }

    pub(super) fn largest_position(&self) -> T {
        norm_inf(&[norm_inf(&self.problem.terms.phi), norm_inf(&self.problem.residuals)])
    }

    /// Largest residual of all rows: its size, its owner, and the entry if it is a held row.
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
