//! Newton's iteration of a step: the sizes of its corrections, and the criteria for its end.

use super::StepEnd;
use crate::Real;
use crate::model::Model;
use crate::step::{StepError, Stop, largest, largest_or_nan};
use crate::team::norm_inf;

/// Correction at machine precision [EPSILON of the increment of the step, or of the scene's length]. Six binary digits are allowed for
/// sums.
const ROUNDING: f64 = 64.0;
/// Correction at machine precision of a state without motion [EPSILON of the coordinates]: a rounded coordinate enters a row in few
/// products.
const ROUNDING_AT_REST: f64 = 4.0;
/// Number of iterations after which a slow iteration may end at machine precision or near a singular position [-]. Five corrections that
/// each shrink to a fifth gain three digits.
const MANY: u32 = 5;
/// Correction at which a slow iteration may end near a singular position [displacement of the step]. A combination of constraints has
/// almost no effect there, so its multiplier cannot be improved.
const PASSAGE: f64 = 1e-5;
/// Last correction that is accepted after the largest number of iterations [displacement of the step]: a tenth of `PASSAGE`.
const ACCEPTED: f64 = 1e-6;

/// Newton's iteration of one step: its corrections so far [m or -], and the sizes that they are compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newton<T> {
    /// Displacement that accelerations cause in the step [m].
    pub scale: T,
    /// Size of a small correction, relative to `scale` [-].
    pub tolerance: T,
    /// Length of the scene [m].
    pub length: T,
    /// Number of corrections so far.
    pub iterations: u32,
    /// Size of the first correction; zero before the first one.
    pub first: T,
    /// Sizes of the last two corrections, the latest last; zero before they exist.
    pub corrections: [T; 2],
}

impl<T: Real> Newton<T> {
    /// State of the iteration before its first correction.
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

    /// Records the correction -`f` of the coordinates at `end`. Returns the reason if the iteration ends.
    ///
    /// Machine precision refers to the increments of coordinates if these are summed (`compensated`), else to the scene's length. In
    /// equilibrium, or in uniform motion, corrections contain only rounding errors of balanced forces and of guided positions. Slow
    /// corrections in the last digits of the coordinates are therefore accepted. Corrections below the squared machine precision are
    /// accepted too.
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

    /// Records a correction of the given size. `f` identifies the unknown if the size is not finite.
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

    /// Reason to end the iteration with the last correction, if it ends. A correction below `goal` is small; a slow correction below
    /// `noise` is at machine precision.
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

    /// Correction at machine precision if the coordinates moved by `moved`.
    #[inline]
    pub fn rounding(moved: T) -> T {
        moved * T::EPSILON * T::from_f64(ROUNDING)
    }

    /// Summary of an iteration that ended with `stop`: iterations, size of the last correction, reason.
    #[inline]
    pub fn ended(&self, stop: Stop) -> (u32, T, Stop) {
        (self.iterations, self.last(), stop)
    }

    /// True if, after the largest number of iterations, the last correction is small relative to the displacement of the step. It may be
    /// above its tolerance.
    #[inline]
    pub fn is_accepted(&self) -> bool {
        self.last() <= self.scale * T::from_f64(ACCEPTED)
    }

    /// Error of an iteration that did not converge. `f` is the last correction of the unknowns.
    #[cold]
    pub fn failure(&self, f: &[T]) -> StepError {
        let (iterations, unknown) = (self.iterations, largest(f));
        let correction = (self.last() / self.length).to_f64();
        StepError::NotConverged { iterations, correction, unknown }
    }
}
