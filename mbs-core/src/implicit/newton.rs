//! Newton's iteration of a step: its corrections, and when it is over.

use super::StepEnd;
use crate::Real;
use crate::model::Model;
use crate::step::{StepError, Stop, largest, largest_or_nan};
use crate::team::norm_inf;

/// A correction that is rounding [EPSILON of the increment of the step, or of the scene's length]: six binary digits for the sums of a solution.
const ROUNDING: f64 = 64.0;
/// A correction that is rounding at rest [EPSILON of the coordinates]: a few products, by which one such number enters a row.
const ROUNDING_AT_REST: f64 = 4.0;
/// Iterations after which corrections that no longer shrink may be rounding at rest, or a passage [-]: five that shrink to a fifth each have
/// left three digits behind.
const MANY: u32 = 5;
/// A correction that no longer shrinks is left within reach of a singular position [displacement of the step]: a combination of constraints
/// that has almost no effect there keeps the multiplier that it had.
const PASSAGE: f64 = 1e-5;
/// The last correction that is accepted after all iterations [displacement of the step]: a tenth of a passage.
const ACCEPTED: f64 = 1e-6;

/// The iteration of one step: the sizes that its corrections are compared with, and the corrections so far [m or -].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newton<T> {
    /// The displacement that accelerations cause in the step [m].
    pub scale: T,
    /// A correction below this times `scale` is small [-].
    pub tolerance: T,
    /// Length of the scene [m].
    pub length: T,
    /// Number of corrections so far.
    pub iterations: u32,
    /// Size of the first correction; zero before it.
    pub first: T,
    /// The last two, the later one last; zero before them.
    pub corrections: [T; 2],
}

impl<T: Real> Newton<T> {
    /// Before the first correction.
    #[inline]
    pub fn new((scale, tolerance, length): (T, T, T)) -> Self {
        let zero = T::ZERO;
        Self { scale, tolerance, length, iterations: 0, first: zero, corrections: [zero; 2] }
    }

    /// Size of the last correction.
    #[inline]
    pub fn last(&self) -> T {
        self.corrections[1]
    }

    /// Takes the correction -`f` of the coordinates at `end` in; returns what ends the iteration, if it is over.
    ///
    /// Rounding is that of the increment where increments are carried (`compensated`), else of the scene's length. At rest, and in a uniform
    /// motion, nothing moves but the rounding of forces in balance and of guided places: what no longer shrinks among the last digits of
    /// the coordinates, of which directions are of order one, is that; and what is below the last digit of a pair of numbers is nothing.
    ///
    /// # Errors
    /// [`StepError::NotFinite`].
    #[inline]
    pub fn take<M: Model<T>>(
        &mut self,
        model: &M,
        f: &[T],
        (end, compensated): (&StepEnd<T>, bool),
    ) -> Result<Option<Stop>, StepError> {
        let correction = norm_inf(model.team(), f);
        self.count(correction, f)?;
        let Self { scale, tolerance, length, iterations, .. } = *self;
        let goal = (scale * tolerance).max(length * T::EPSILON * T::EPSILON);
        if iterations < 2 || correction <= goal {
            return Ok(self.stop(goal, T::ZERO));
        }
        let moved = if compensated { norm_inf(model.team(), end.moved()) } else { length };
        let mut noise = Self::rounding(moved);
        if iterations > MANY {
            let farthest = length.max(T::ONE).max(norm_inf(model.team(), &end.q));
            noise = noise.max(farthest * T::EPSILON * T::from_f64(ROUNDING_AT_REST));
        }
        Ok(self.stop(goal, noise))
    }

    /// Counts a correction of this size; `f` names the unknown where it is not finite.
    ///
    /// # Errors
    /// [`StepError::NotFinite`].
    #[inline]
    pub fn count(&mut self, correction: T, f: &[T]) -> Result<(), StepError> {
        if !correction.is_finite() {
            return Err(StepError::NotFinite { unknown: largest_or_nan(f) });
        }
        if self.iterations == 0 {
            self.first = correction;
        }
        self.corrections = [self.last(), correction];
        self.iterations += 1;
        Ok(())
    }

    /// Reason to end the iteration with the last correction, if it is over: a correction below `goal` is small, one of `noise` is
    /// rounding.
    #[inline]
    pub fn stop(&self, goal: T, noise: T) -> Option<Stop> {
        let [before, last] = self.corrections;
        if last <= goal {
            return Some(Stop::Converged);
        }
        if self.iterations < 2 {
            return None;
        }
        let contraction = last / before;
        let is_slow = contraction > T::HALF;
        if contraction < T::HALF && last * contraction <= goal {
            Some(Stop::Converged)
        } else if is_slow && last <= noise {
            Some(Stop::Rounding)
        } else if is_slow && self.iterations > MANY && last <= self.scale * T::tolerance(PASSAGE) {
            Some(Stop::Passage)
        } else {
            None
        }
    }

    /// A correction of the size of rounding where the coordinates moved by this much.
    #[inline]
    pub fn rounding(moved: T) -> T {
        moved * T::EPSILON * T::from_f64(ROUNDING)
    }

    /// Report on an iteration that ended so: iterations, size of the last correction, and the reason.
    #[inline]
    pub fn ended(&self, stop: Stop) -> (u32, T, Stop) {
        (self.iterations, self.last(), stop)
    }

    /// After the allowed iterations: is the last correction small beside the displacement of the step, though not below its tolerance?
    #[inline]
    pub fn is_accepted(&self) -> bool {
        self.last() <= self.scale * T::from_f64(ACCEPTED)
    }

    /// The iteration did not converge; `f` are the unknowns.
    #[cold]
    pub fn failure(&self, f: &[T]) -> StepError {
        let (iterations, unknown) = (self.iterations, largest(f));
        let correction = (self.last() / self.length).to_f64();
        StepError::NotConverged { iterations, correction, unknown }
    }
}
