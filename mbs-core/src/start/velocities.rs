//! Smallest velocities that satisfy all rates: a linear problem, whose matrix is factored once unless penalties are raised.

use super::error::AssemblyError;
use super::problem::{Level, MAX_SWEEPS, SLOW_RATIO, raises};
use super::sweeps::Assembly;
use crate::Real;
use crate::blocks::{Cliques, SpdSolver};
use crate::model::{Model, State};

impl<T: Real, S: SpdSolver<T>, const D: usize> Assembly<'_, T, S, D> {
    /// Sets `s.v` to the smallest velocity that satisfies all rates, at the positions last evaluated.
    pub(super) fn velocities(&mut self, s: &mut State<T>) -> Result<(), AssemblyError> {
        let n = self.problem.n_unknowns();
        if self.problem.model.has_velocity_rows() {
            self.problem.model.evaluate(&s.q, &mut self.problem.terms);
        }
        self.problem.model.evaluate_phi_t(&s.q, &mut self.problem.terms);
        self.problem.holds.iter_mut().for_each(|hold| hold.place_rate(&s.q));
        self.problem.lower_penalties();
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        self.measure_rates(&s.v);
        let asked = self.worst(&self.rows);
        if asked == T::ZERO {
            return Ok(());
        }
        self.factor(Level::Velocity, None, T::ZERO)?;
        let (mut residual, mut last, mut raises) = (asked, None, raises::<T>());
        for _ in 0..MAX_SWEEPS {
            self.load();
            self.solve(Level::Velocity);
            for i in 0..n {
                s.v[i] -= self.f[i];
                self.change[i] -= self.f[i];
            }
            self.measure_rates(&s.v);
            for (k, &p) in self.problem.penalty.iter().enumerate() {
                self.sigma[k] += p * self.rows[k];
            }
            let (correction, left) = (self.largest(&self.f), self.worst(&self.rows));
            let scale = self.largest(&s.v).max(asked);
            let is_met = left <= scale * self.accepted(&s.q);
            let is_slow = left > residual * T::from_f64(SLOW_RATIO) && !is_met;
            let stalls = last.is_some_and(|last| correction > last * T::HALF);
            if correction <= scale * T::EPSILON || (is_met && stalls) {
                break;
            }
            (residual, last) = (left, Some(correction));
            if is_slow && raises > 0 {
                self.problem.raise_penalties();
                self.factor(Level::Velocity, None, T::ZERO)?;
                (raises, last) = (raises - 1, None);
            }
        }
        let scale = self.largest(&s.v).max(asked);
        if self.is_met(Level::Velocity, scale * self.accepted(&s.q), &s.v) {
            return Ok(());
        }
        let (residual, owner, initial) = self.culprit();
        Err(AssemblyError::Velocity { residual: residual.to_f64(), owner, initial })
    }

    /// Computes the residuals J v + phi_t of the model, and those of the prescribed rates.
    fn measure_rates(&mut self, v: &[T]) {
        let p = &self.problem;
        p.multiply(v, Level::Velocity, &mut self.rows);
        let (rows, holds) = self.rows.split_at_mut(p.model.n_constraints());
        for (r, &b) in rows.iter_mut().zip(&p.terms.phi_t) {
            *r += b;
        }
        for (r, hold) in holds.iter_mut().zip(&p.holds) {
            *r -= hold.rate.unwrap_or(T::ZERO);
        }
    }
}
