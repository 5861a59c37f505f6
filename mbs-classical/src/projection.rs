//! Projection of positions, velocities and accelerations with the saddle matrix, in correction form.
//!
//! ```text
//! [ W  J^T    ] ( d       )     ( M (x - x*) + J^T sigma )
//! [ J  -delta ] ( d_sigma ) = - ( J x + b                ),     x += d,   sigma += d_sigma
//! ```
//!
//! [P3 (21), (22)] solve for x itself with the weight W; the correction loses no digits to the condition of the matrix. The
//! first sweep is the published projection. The next ones make it orthogonal in the mass, whatever forces are in W, and remove
//! what a factor of a near configuration or delta left.

use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::{norm_inf, on_stretches, subtract};
use mbs_core::{Real, SymmetricSolver};

/// Part of the first correction below which the next ones change the orthogonality of a projection no more [-]: three digits of a correction
/// that is small itself.
const ORTHOGONAL: f64 = 1e-3;

impl<T: Real, S: SymmetricSolver<T>> Workspace<T, S> {
    /// rates = J x + b of the level; returns their largest absolute value.
    pub(crate) fn violation<M: Model<T>>(&mut self, model: &M, level: ConstraintLevel) -> T {
        let x = match level {
            ConstraintLevel::Velocity => &self.end.v,
            ConstraintLevel::Acceleration => &self.end.a,
        };
        level.violation(model, &self.terms, x, &mut self.rates)
    }

    /// Projects v, then a (unscaled), and balances the multipliers `unit` lambda with a; they are left in `mu`. Returns the
    /// violation left at each level. The matrix is factored near q.
    pub(crate) fn project_velocities_and_accelerations<M: Model<T>>(
        &mut self,
        model: &M,
        (length, unit): (T, T),
        max_sweeps: u32,
    ) -> Result<[T; 3], StepError> {
        let level = ConstraintLevel::Velocity;
        let limits = level.limits(model, &self.end, length, &mut self.terms)?;
        let velocity = self.project(model, level, limits, max_sweeps)?;
        let level = ConstraintLevel::Acceleration;
        let limits = level.limits(model, &self.end, length, &mut self.terms)?;
        let acceleration = self.project(model, level, limits, max_sweeps)?;
        self.end.evaluate_forces(model, &mut self.terms);
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
        level: ConstraintLevel,
        ResidualLimits { goal, limit, .. }: ResidualLimits<T>,
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
                ConstraintLevel::Velocity => &mut self.end.v,
                ConstraintLevel::Acceleration => &mut self.end.a,
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
        Err(level.violated(violation, &self.rates))
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
