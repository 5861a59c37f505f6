//! Projection of positions, velocities and accelerations with the saddle matrix, in correction form.
//!
//! ```text
//! [ W  J^T    ] ( d       )     ( M (x - x*) + J^T sigma )
//! [ J  -delta ] ( d_sigma ) = - ( J x + b                ),     x += d,   sigma += d_sigma
//! ```
//!
//! [P3 (21), (22)] solve for x itself with the weight W; the correction loses no digits to the condition of the matrix. The
//! first sweep is the printed projection; the next ones make it orthogonal in the mass, whatever forces are in W, and remove
//! what a factor of a near configuration or delta left.

use crate::workspace::{Mass, Workspace};
use mbs_core::model::Model;
use mbs_core::step::{StepError, check_guides, largest};
use mbs_core::team::{norm_inf, on_stretches, subtract};
use mbs_core::{Real, SymmetricSolver};

/// Violation of a level that is accepted when no sweep lowers it further, relative to the size of the level.
const LIMIT: f64 = 5e-10;

/// A correction below this times the first one changes the orthogonality of a projection no more.
const ORTHOGONAL: f64 = 1e-3;

/// Which vector is projected, with its right-hand side b.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    /// J v + phi_t = 0.
    Velocity,
    /// J a + bias = 0.
    Acceleration,
}

impl<T: Real, S: SymmetricSolver<T>> Workspace<T, S> {
    /// rates = J x + b of the level; returns their largest absolute value.
    pub(crate) fn violation<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        let (x, b) = match level {
            Level::Velocity => (&self.v, &self.terms.phi_t),
            Level::Acceleration => (&self.a, &self.terms.phi_bias),
        };
        model.multiply_jacobian(&self.terms, x, &mut self.rates);
        if level == Level::Acceleration || model.has_guides() {
            on_stretches(model.team(), [&mut self.rates], |first, [rates]| {
                for (r, &b) in rates.iter_mut().zip(&b[first..]) {
                    *r += b;
                }
            });
        }
        norm_inf(model.team(), &self.rates)
    }

    /// Projects v, then a (unscaled), and balances the multipliers `unit` lambda with a; they are left in `mu`. Returns the
    /// violation left at each level. The matrix is factored near q.
    pub(crate) fn clean<M: Model<T>>(
        &mut self,
        model: &M,
        (length, unit): (T, T),
        max_sweeps: u32,
    ) -> Result<[T; 3], StepError> {
        if model.has_guides() {
            model.evaluate_phi_t(&self.q, &mut self.terms);
            check_guides(model, &self.q, &self.terms)?;
        }
        let rounding = T::EPSILON * T::from_f64(1024.0);
        let limit = T::from_f64(LIMIT).max(rounding);
        let speed = norm_inf(model.team(), &self.v);
        let goal = (speed * T::EPSILON * T::from_f64(16.0), (length + speed) * limit);
        let velocity = self.project(model, Level::Velocity, goal, max_sweeps)?;

        model.evaluate_bias(&self.q, &self.v, &mut self.terms);
        let size =
            norm_inf(model.team(), &self.a).max(norm_inf(model.team(), &self.terms.phi_bias));
        let goal = (size * rounding, (T::ONE + size) * limit);
        let acceleration = self.project(model, Level::Acceleration, goal, max_sweeps)?;

        self.evaluate_forces(model);
        self.balance(model, unit);
        Ok([norm_inf(model.team(), &self.terms.phi), velocity, acceleration])
    }

    /// Projects v or a; the multipliers are left in `sigma`. Returns the violation left.
    ///
    /// Sweeps until the violation is at most `goal`, or stops shrinking below `limit`, and corrections have become small
    /// beside the first one, or stop shrinking.
    fn project<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        (goal, limit): (T, T),
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        let mut violation = self.violation(model, level);
        if violation <= goal {
            return Ok(violation);
        }
        let (mut first, mut last) = (T::ZERO, T::ZERO);
        for sweeps in 0..max_sweeps {
            self.sweep(model, sweeps > 0);
            let x = match level {
                Level::Velocity => &mut self.v,
                Level::Acceleration => &mut self.a,
            };
            subtract(model.team(), &mut x[..self.n], &self.f);
            let left = self.violation(model, level);
            let is_level = left <= goal || (left > violation * T::HALF && left <= limit);
            violation = left;
            let correction = norm_inf(model.team(), &self.f[..self.n]);
            let is_orthogonal = correction <= first * T::from_f64(ORTHOGONAL);
            if is_level && sweeps > 0 && (is_orthogonal || correction > last * T::HALF) {
                return Ok(violation);
            }
            if sweeps == 0 {
                first = correction;
            }
            last = correction;
        }
        if violation <= limit {
            return Ok(violation);
        }
        let level = if level == Level::Velocity { 1 } else { 2 };
        let row = largest(&self.rates);
        Err(StepError::Violated { level, violation: violation.to_f64(), row })
    }

    /// One sweep on the violation in `rates`; as long as nothing `is_changed` mass and sigma have no part in it. The
    /// correction is left in `f`, to be subtracted.
    pub(crate) fn sweep<M: Model<T>>(&mut self, model: &M, is_changed: bool) {
        self.mu.copy_from_slice(&self.sigma);
        self.assemble(model, if is_changed { Mass::Change } else { Mass::None }, T::ZERO, true);
        self.solve();
        let (d, d_sigma) = self.f.split_at(self.n);
        subtract(model.team(), &mut self.change[..self.n], d);
        subtract(model.team(), &mut self.sigma, d_sigma);
    }

    /// mu = the multipliers for which M a + J^T mu - Q is smallest (in the metric W^-1): one solution from those at hand.
    ///
    /// ```text
    /// [ W  J^T    ] ( d )     ( M a + J^T mu - Q )
    /// [ J  -delta ] ( e ) =   ( 0                ),     mu -= e
    /// ```
    fn balance<M: Model<T>>(&mut self, model: &M, unit: T) {
        let (lambda, sigma) = (&self.lambda, &self.sigma);
        on_stretches(model.team(), [&mut self.mu], |first, [mu]| {
            for (k, mu) in mu.iter_mut().enumerate() {
                *mu = lambda[first + k] * unit + sigma[first + k];
            }
        });
        self.assemble(model, Mass::Acceleration, T::ONE, false);
        self.solve();
        subtract(model.team(), &mut self.mu, &self.f[self.n..]);
    }
}
