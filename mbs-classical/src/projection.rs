//! Projection of positions, velocities and accelerations with the saddle matrix, in correction form.
//!
//! ```text
//! [ W  J^T    ] ( d       )     ( M (x - x*) + J^T sigma )
//! [ J  -delta ] ( d_sigma ) = - ( J x + b                ),     x += d,   sigma += d_sigma
//! ```
//!
//! The published projections [P3 (21), (22)] solve for x itself with the weight W. The correction form loses no digits to the condition of
//! the matrix. The first sweep is the published projection. Further sweeps make it orthogonal in the mass, even if W contains stiffness and
//! damping. They also remove the error that delta leaves, and the error of a factor from another configuration.

use crate::workspace::{Mass, Workspace};
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::{norm_inf, on_stretches, subtract};
use mbs_core::{Real, SymmetricSolver};

/// Ratio to the first correction below which a correction no longer affects the orthogonality of a projection [-]. Three digits of a small
/// correction are enough.
const ORTHOGONAL: f64 = 1e-3;

impl<T: Real, S: SymmetricSolver<T>> Workspace<T, S> {
    /// Evaluates rates = J x + b of the level. Returns the largest absolute value.
    pub(crate) fn violation<M: Model<T>>(&mut self, model: &M, level: ConstraintLevel) -> T {
        let x = match level {
            ConstraintLevel::Velocity => &self.end.v,
            ConstraintLevel::Acceleration => &self.end.a,
        };
        level.violation(model, &self.terms, x, &mut self.rates)
    }

    /// Projects v, then a (unscaled), and balances the multipliers `unit` lambda with a. Leaves the balanced multipliers in `mu`. Returns
    /// the violation of each level. Needs the matrix factored at a configuration close to q.
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

    /// Projects v or a and leaves the multipliers in `sigma`. Returns the remaining violation.
    ///
    /// Sweeps end when two conditions hold. First, the violation is at most `goal`, or it is below `limit` and no longer shrinks. Second,
    /// corrections are small relative to the first one, or they no longer shrink.
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

    /// Makes one sweep for the violation in `rates`. The right-hand side contains the mass and sigma only if x already differs from x*
    /// (`is_changed`). Leaves the negative correction in `f`.
    pub(crate) fn sweep<M: Model<T>>(&mut self, model: &M, is_changed: bool) {
        self.mu.copy_from_slice(&self.sigma);
        self.assemble(model, if is_changed { Mass::Change } else { Mass::None }, T::ZERO, true);
        self.solve();
        let (d, d_sigma) = self.f.split_at(self.n);
        subtract(model.team(), &mut self.change[..self.n], d);
        subtract(model.team(), &mut self.sigma, d_sigma);
    }

    /// Solves for the multipliers mu that minimise M a + J^T mu - Q in the metric W^-1, by one solution that starts from the present ones.
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
