//! Request for a step, and the report on the step in counts.

use super::error::StepError;
use crate::Real;

/// Request for a step of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T> {
    /// Length of the step [s].
    pub dt: T,
    /// Length of the scene, with which corrections and violations are compared [m].
    pub length: T,
}

impl<T: Real> Step<T> {
    /// Checks that both lengths are positive and finite, and returns the step.
    ///
    /// # Errors
    /// [`StepError::BadStep`] if they are not.
    #[inline]
    pub fn checked(self) -> Result<Self, StepError> {
        let Self { dt, length } = self;
        let is_length = |x: T| x > T::ZERO && x.is_finite();
        if is_length(dt) && is_length(length) {
            return Ok(self);
        }
        Err(StepError::BadStep { dt: dt.to_f64(), length: length.to_f64() })
    }
}

/// Reason why the iteration of a step ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The next correction, estimated from the last two, is below the tolerance.
    Converged,
    /// Corrections no longer decrease and are at machine precision.
    Rounding,
    /// The step ended close to a singular position. A combination of constraints has almost no effect there, and its multiplier keeps its
    /// extrapolated value.
    Passage,
    /// The largest number of iterations was used. The last correction is above the tolerance, but small relative to the step.
    Tolerance,
    /// There was no iteration, since the method is explicit.
    Explicit,
}

/// Counts of a step's operations with matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of factorisations of a matrix.
    pub factorizations: u32,
    /// Number of solutions with a factor.
    pub solves: u32,
}

/// Report on a step. It has counts only; the caller measures time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport<T> {
    /// Number of iterations; in relative coordinates the number of evaluations of the accelerations.
    pub iterations: u32,
    /// Number of factorisations of a matrix.
    pub factorizations: u32,
    /// Number of solutions with a factor.
    pub solves: u32,
    /// Number of accepted steps inside this one: 1, or more if the method controls its step size.
    pub steps: u32,
    /// Number of rejected steps inside this one.
    pub rejected: u32,
    /// Last correction of a coordinate [m or -].
    pub correction: T,
    /// Reason why the iteration ended.
    pub stop: Stop,
    /// Largest |phi|, |phi'|, |phi''| after the step [m, m/s, m/s^2].
    pub violation: [T; 3],
    /// Energy in the penalties after the first correction [P2 (29)] [J]; zero in formulations without penalties.
    pub penalty_energy: T,
}

impl<T: Real> StepReport<T> {
    /// Report of a step by Newton's method: iterations, last correction and reason of the end; counts; largest violations.
    pub fn of_newton(
        (iterations, correction, stop): (u32, T, Stop),
        Counts { factorizations, solves }: Counts,
        violation: [T; 3],
    ) -> Self {
        let rest = Self::default();
        Self { iterations, factorizations, solves, correction, stop, violation, ..rest }
    }
}

impl<T: Real> StepReport<T> {
    /// Adds the counts of the following step. Violations and penalty energy are the larger values; all other values are those of the
    /// following step.
    pub fn add(&mut self, next: &Self) {
        let sums = Self {
            iterations: self.iterations + next.iterations,
            factorizations: self.factorizations + next.factorizations,
            solves: self.solves + next.solves,
            steps: self.steps + next.steps,
            rejected: self.rejected + next.rejected,
            penalty_energy: self.penalty_energy.max(next.penalty_energy),
            ..*next
        };
        let violation = core::array::from_fn(|i| self.violation[i].max(next.violation[i]));
        *self = Self { violation, ..sums };
    }
}

impl<T: Real> Default for StepReport<T> {
    fn default() -> Self {
        Self {
            iterations: 0,
            factorizations: 0,
            solves: 0,
            steps: 1,
            rejected: 0,
            correction: T::ZERO,
            stop: Stop::Converged,
            violation: [T::ZERO; 3],
            penalty_energy: T::ZERO,
        }
    }
}
