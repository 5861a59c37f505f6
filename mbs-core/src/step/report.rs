//! Request for a step, and the report on what it did, in counts.

use super::error::StepError;
use crate::Real;

/// A step that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step<T> {
    /// Length of the step [s].
    pub dt: T,
    /// Length of the scene, beside which corrections and violations are small [m].
    pub length: T,
}

impl<T: Real> Step<T> {
    /// The step, if both lengths are positive and finite.
    ///
    /// # Errors
    /// [`StepError::BadStep`].
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

/// Why the iteration of a step ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The next correction, estimated from the last two, is below the tolerance of the step.
    Converged,
    /// Corrections no longer shrink and are at the level of rounding.
    Rounding,
    /// The step ended within reach of a singular position: the multiplier of a combination of constraints that has almost no
    /// effect there is left as it was extrapolated.
    Passage,
    /// The allowed iterations are used, and the last correction is small beside the step though not below its tolerance.
    Tolerance,
    /// No iteration, since the method is explicit.
    Explicit,
}

/// Counts of a step's work with matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of factorisations made.
    pub factorizations: u32,
    /// Number of back-substitutions made.
    pub solves: u32,
}

/// Report on what a step did. Counts only; time is measured from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport<T> {
    /// Number of iterations made; in relative coordinates, of evaluations of the accelerations.
    pub iterations: u32,
    /// Number of factorisations made.
    pub factorizations: u32,
    /// Number of back-substitutions made.
    pub solves: u32,
    /// Accepted steps inside this one: 1, more where a step size is controlled inside.
    pub steps: u32,
    /// Rejected steps inside this one.
    pub rejected: u32,
    /// Last correction of a coordinate [m or -].
    pub correction: T,
    /// Reason why the iteration ended.
    pub stop: Stop,
    /// Largest |phi|, |phi'|, |phi''| after the step [m, m/s, m/s^2].
    pub violation: [T; 3],
    /// Energy that the penalties held after the first correction [P2 (29)]; zero in formulations without penalties [J].
    pub penalty_energy: T,
}

impl<T: Real> StepReport<T> {
    /// Of a step by Newton's method: iterations, the last correction and what ended them; work; largest violations.
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
    /// Adds the counts of a step that followed; the rest is that step's, the larger where it is a size.
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
