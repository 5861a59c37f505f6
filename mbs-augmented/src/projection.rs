//! Mass-orthogonal projection of velocities and accelerations, in correction form.
//!
//! ```text
//! min (x - x*)^T M (x - x*)  subject to  J x + b = 0
//!
//! W d = -[M (x - x*) + J^T (sigma + s (J x + b))],   x += d,   sigma += s (J x + b),     W = M + J^T s J
//! ```
//!
//! [P1 (11)-(14), (17)-(19)] solve for x itself, which loses cond(W) eps at every step; the correction does not.
//! One sweep leaves 1 / (1 + s sigma^2 / m) of a violation in a direction with singular value sigma; it is swept until
//! the level is reached. Any factored matrix near W will do: the fixed point does not depend on it.

use crate::error::StepError;
use crate::workspace::{Mass, Workspace};
use mbs_core::algebra::norm_inf;
use mbs_core::model::Model;
use mbs_core::{Real, SpdSolver};

/// A sweep that leaves more than this share of the violation is slow.
const SLOW: f64 = 1e-2;
/// The most that slow sweeps may raise the penalties.
const MOST: f64 = 1e7;

/// Which vector is projected, with its right-hand side b.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    /// J v + phi_t = 0.
    Velocity,
    /// J a + bias = 0.
    Acceleration,
}

impl<T: Real, S: SpdSolver<T>> Workspace<T, S> {
    /// rates = J x + b of the level; returns their largest absolute value.
    pub(crate) fn violation<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        let (x, b) = match level {
            Level::Velocity => (&self.v, &self.terms.phi_t),
            Level::Acceleration => (&self.a, &self.terms.phi_bias),
        };
        model.multiply_jacobian(&self.terms, x, &mut self.rates);
        if level == Level::Acceleration || model.has_guides() {
            for (r, &b) in self.rates.iter_mut().zip(b) {
                *r += b;
            }
        }
        norm_inf(&self.rates)
    }

    /// Projects v or a with the factored matrix; the multipliers are left in `sigma`. Returns the violation left.
    ///
    /// Sweeps at least once unless the level holds already, until the violation is at most `goal`, or stops shrinking below
    /// `limit`.
    pub(crate) fn project<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        (goal, limit): (T, T),
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        let mut violation = self.violation(model, level);
        for _ in 0..max_sweeps {
            if violation <= goal {
                return Ok(violation);
            }
            self.sweep(model, level);
            let left = self.violation(model, level);
            for i in 0..self.sigma.len() {
                self.sigma[i] += self.penalty[i] * self.rates[i];
            }
            let contraction = left / violation;
            violation = left;
            if contraction > T::HALF && violation <= limit {
                return Ok(violation);
            }
            let is_slow = contraction > T::from_f64(SLOW) && violation > limit;
            if is_slow && self.stiffen(contraction.min(T::ONE)) {
                self.factor(model, (T::ZERO, T::ZERO), false)?;
            }
        }
        if violation <= limit {
            return Ok(violation);
        }
        let level = if level == Level::Velocity { 1 } else { 2 };
        let row = largest(&self.rates);
        Err(StepError::Violated { level, violation: violation.to_f64(), row })
    }

    /// Raises the penalties until corrections contract by [`SLOW`]: a direction is nearly lost to the constraints.
    ///
    /// One correction leaves rho = m / (m + s sigma^2): for rho' = SLOW the penalty must grow by rho / (1 - rho) / SLOW.
    /// Returns whether anything changed.
    pub(crate) fn stiffen(&mut self, contraction: T) -> bool {
        let kept = (T::ONE - contraction).max(T::from_f64(1e-2));
        let growth = (contraction / kept / T::from_f64(SLOW)).min(T::from_f64(MOST) / self.boost);
        if growth <= T::ONE {
            return false;
        }
        self.boost *= growth;
        for p in &mut self.penalty {
            *p *= growth;
        }
        true
    }

    fn sweep<M: Model<T>>(&mut self, model: &M, level: Level) {
        for i in 0..self.mu.len() {
            self.mu[i] = self.sigma[i] + self.penalty[i] * self.rates[i];
        }
        self.assemble(model, Mass::Change, T::ZERO);
        self.solve();
        let x = match level {
            Level::Velocity => &mut self.v,
            Level::Acceleration => &mut self.a,
        };
        for i in 0..self.f.len() {
            x[i] -= self.f[i];
            self.change[i] -= self.f[i];
        }
    }
}

/// Index of the entry largest in absolute value.
pub(crate) fn largest<T: Real>(x: &[T]) -> u32 {
    let mut best = 0;
    for i in 1..x.len() {
        if x[i].abs() > x[best].abs() {
            best = i;
        }
    }
    u32::try_from(best).unwrap_or(u32::MAX)
}
