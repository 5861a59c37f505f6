//! Mass-orthogonal projection with a factor that was made nearby, by one sweep.
//!
//! ```text
//! T' d = -J'^T s (J x + b),   x += d,   sigma += s (J x* + b + J' d),     T' = M + J'^T s J'
//! ```
//!
//! J' are the rows that the factor was made with, J those of now. With J^T on the right d has a part s (J - J')^T (J x + b) / m
//! along free directions, which s multiplies and only a second sweep takes back; with J'^T it has none. What is left is the
//! violation times what the penalties leave and times the turn of the rows, and d is orthogonal to directions that are off by the
//! turn: that is why the factor has to be from before a correction that was small already.

use crate::projection::{Level, ResidualLimits};
use crate::workspace::{Mass, Workspace};
use core::mem::swap;
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::{add, add_product, on_stretches, set_product, subtract};
use mbs_core::{Real, SpdSolver};

/// Of a violation may be left, in EPSILON of what it stands beside: of velocities, and of accelerations, which enter the motion times
/// the square of the step.
const LEFT: [f64; 2] = [8_192.0, 2_097_152.0];
/// But no more than this share, or in any precision so many EPSILON of rounding.
const MOST: f64 = 5e-10;
const ROUNDING: f64 = 1024.0;
/// A sweep that leaves more than this share of a violation is followed by those with the rows of now.
const SLOW: f64 = 0.01;

impl<T: Real, S: SpdSolver<T>> Workspace<T, S> {
    /// Projects v or a, nearby or with the rows of now; `size` is what a violation stands beside, with and without what keeps it
    /// from zero. Returns the violation left.
    pub(crate) fn clean<M: Model<T>>(
        &mut self,
        model: &M,
        (level, is_nearby): (Level, bool),
        [size, bare]: [T; 2],
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        let rounding = T::EPSILON * T::from_f64(ROUNDING);
        let limit = size * T::from_f64(MOST).max(rounding);
        let k = usize::from(level == Level::Acceleration);
        let goal = bare * T::EPSILON * T::from_f64([16.0, ROUNDING][k]);
        let enough = (size * T::EPSILON * T::from_f64(LEFT[k])).min(limit);
        if is_nearby {
            return self.project_nearby(
                model,
                level,
                ResidualLimits { goal, enough, limit },
                max_sweeps,
            );
        }
        let enough = if model.has_forces() { enough } else { goal };
        self.project(model, level, ResidualLimits { goal, enough, limit }, max_sweeps)
    }

    /// Projects v or a, once unless the violation is at most `goal`, then by sweeps of this kind while they shrink it until it is
    /// `enough`, else as [`project`](Self::project) does. The multipliers of accelerations are left in `sigma`. Returns the violation
    /// left.
    ///
    /// Cost: a solve and three products of the Jacobian for each sweep, with velocities mostly two; mostly there is one.
    fn project_nearby<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        allowed: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        let ResidualLimits { goal, enough, .. } = allowed;
        self.begin();
        let mut violation = self.violation(model, level);
        let (mut sweeps, mut most) = (0, goal);
        // a NaN is no violation that may be left
        while !(violation <= most) {
            most = enough;
            self.sweep_nearby(model, level);
            sweeps += 1;
            let mut left = self.violation(model, level);
            if left > enough && sweeps == 1 {
                left = self.lengthen_first(model, level);
            }
            let is_slow = !(left <= violation * T::from_f64(SLOW));
            if is_slow && !(left <= enough) {
                return self.project_on(model, level, allowed, (sweeps, max_sweeps));
            }
            violation = left;
        }
        Ok(violation)
    }

    /// f = M a + J^T lambda - force Q + J'^T s phi: the residual of a step for a factor that is kept. Cost: two residuals.
    pub(crate) fn balance_nearby<M: Model<T>>(&mut self, model: &M, force: T) {
        let n = self.f.len();
        self.mu.copy_from_slice(&self.lambda);
        self.assemble(model, Mass::Acceleration, force);
        self.dq_predicted[..n].copy_from_slice(&self.f);
        set_product(model.team(), &mut self.mu, (&self.penalty, &self.terms.phi));
        self.assemble_factored(model);
        add(model.team(), &mut self.f, &self.dq_predicted);
    }

    /// lambda <- lambda + s (phi + J' d) with d = -f: the multipliers that are in balance with the correction. Cost: a product of the
    /// Jacobian.
    pub(crate) fn take_multipliers<M: Model<T>>(&mut self, model: &M) {
        self.multiply_factored(model);
        let (penalty, phi, mu) = (&self.penalty, &self.terms.phi, &self.mu);
        on_stretches(model.team(), [&mut self.lambda], |first, [lambda]| {
            for (i, lambda) in lambda.iter_mut().enumerate() {
                let k = first + i;
                *lambda += penalty[k] * (phi[k] - mu[k]);
            }
        });
    }

    /// f = J'^T mu with the rows of the factor.
    fn assemble_factored<M: Model<T>>(&mut self, model: &M) {
        swap(&mut self.terms.jacobian, &mut self.factored);
        self.assemble(model, Mass::None, T::ZERO);
        swap(&mut self.terms.jacobian, &mut self.factored);
    }

    /// mu = J' f with the rows of the factor.
    fn multiply_factored<M: Model<T>>(&mut self, model: &M) {
        swap(&mut self.terms.jacobian, &mut self.factored);
        self.multiply_correction(model);
        swap(&mut self.terms.jacobian, &mut self.factored);
    }

    /// mu = J f.
    pub(crate) fn multiply_correction<M: Model<T>>(&mut self, model: &M) {
        let n = self.f.len();
        self.dq_predicted[..n].copy_from_slice(&self.f);
        model.multiply_jacobian(&self.terms, &self.dq_predicted, &mut self.mu);
    }

    fn sweep_nearby<M: Model<T>>(&mut self, model: &M, level: Level) {
        set_product(model.team(), &mut self.mu, (&self.penalty, &self.rates));
        self.assemble_factored(model);
        self.solve();
        if level == Level::Acceleration {
            self.multiply_factored(model);
            subtract(model.team(), &mut self.rates, &self.mu);
            add_product(model.team(), &mut self.sigma, (&self.penalty, &self.rates));
        }
        self.take(model, level);
    }

    /// After the first sweep x += k d, sigma += k sigma with the best k: d is short by what the penalties leave, much the same share in
    /// all rows. Needs the last `f` = -d, of accelerations with J' f in `mu`. Returns the violation left.
    fn lengthen_first<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        if level == Level::Velocity {
            self.multiply_correction(model);
        }
        let k = self.best_length(model);
        let by = T::ONE + k;
        on_stretches(model.team(), [&mut self.sigma], |_, [sigma]| {
            sigma.iter_mut().for_each(|sigma| *sigma *= by);
        });
        self.lengthen(model, level, k)
    }
}
