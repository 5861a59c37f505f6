//! Scans of vectors that steps need.

use crate::Real;
use crate::team::{Team, norm_inf};

/// Displacement that accelerations `a` cause in a step of `dt` [m]. Corrections are compared with it.
pub fn step_scale<T: Real, W: Team>(team: &W, dt: T, a: &[T]) -> T {
    norm_inf(team, a) * dt * dt * T::HALF
}

/// Index of the entry with the largest absolute value.
pub fn largest<T: Real>(x: &[T]) -> u32 {
    let (mut best, mut size) = (0, T::ZERO);
    for (i, x) in x.iter().enumerate() {
        if i == 0 || x.abs() > size {
            (best, size) = (i, x.abs());
        }
    }
    u32::try_from(best).unwrap_or(u32::MAX)
}

/// Index of the first entry that is not finite; if all are finite, index of the entry with the largest absolute value.
#[cold]
pub fn largest_or_nan<T: Real>(x: &[T]) -> u32 {
    let bad = x.iter().position(|x| !x.is_finite());
    bad.map_or_else(|| largest(x), |i| u32::try_from(i).unwrap_or(u32::MAX))
}
