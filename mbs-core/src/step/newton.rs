//! When a Newton iteration of a step is over.

use super::report::Stop;
use crate::Real;

/// What corrections of the coordinates are measured against in one step [m or -].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvergenceCriterion<T> {
    /// The displacement that accelerations cause in the step.
    pub scale: T,
    /// A correction below this is small.
    pub goal: T,
    /// A correction of this size is rounding.
    pub noise: T,
}

impl<T: Real> ConvergenceCriterion<T> {
    /// For corrections of the coordinates themselves at iteration `iterations`, in a scene of the given `length` [m].
    ///
    /// Rounding is that of the increment `moved` [m] where increments are carried, else of the coordinates. At rest, and in a uniform
    /// motion, nothing moves but the rounding of forces in balance and of guided places: what no longer shrinks among the last digits of
    /// the coordinates, of which directions are of order one and the `farthest` is asked for late, is that; and what is below the last
    /// digit of a pair of numbers is nothing.
    pub fn of_coordinates(
        iterations: u32,
        (scale, tolerance): (T, T),
        (length, farthest): (T, impl FnOnce() -> T),
        moved: Option<T>,
    ) -> Self {
        let rounding = moved.unwrap_or(length) * T::EPSILON * T::from_f64(64.0);
        // One such number enters a row by a few products.
        let digits = if iterations > 5 {
            length.max(T::ONE).max(farthest()) * T::EPSILON * T::from_f64(4.0)
        } else {
            T::ZERO
        };
        let nothing = length * T::EPSILON * T::EPSILON;
        Self { scale, goal: (scale * tolerance).max(nothing), noise: rounding.max(digits) }
    }
}

/// Is the correction of iteration `iterations` (from 1) the last one? `last` is the correction before it.
pub fn stopping<T: Real>(
    iterations: u32,
    correction: T,
    last: T,
    criterion: &ConvergenceCriterion<T>,
) -> Option<Stop> {
    let ConvergenceCriterion { scale, goal, noise } = *criterion;
    if correction <= goal {
        return Some(Stop::Converged);
    }
    if iterations < 2 {
        return None;
    }
    let contraction = correction / last;
    if contraction < T::HALF && correction * contraction <= goal {
        Some(Stop::Converged)
    } else if contraction > T::HALF && correction <= noise {
        Some(Stop::Rounding)
    } else if iterations > 5 && contraction > T::HALF && correction <= scale * T::tolerance(1e-5) {
        Some(Stop::Passage)
    } else {
        None
    }
}
