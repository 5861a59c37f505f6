//! Features of roads: heights over x.
//!
//! ```text
//! rise    slope 0 -> s -> 0, linear over the rounding r at both ends, s = height / (length - r)
//! bump    A (1 - cos(2 pi (x - x0) / L))
//! ```

use super::entry::entry;
use super::guide;
use super::part::Part;
use crate::Real;

/// Feature of a road. The heights of all features add up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Feature<T> {
    /// Height that is the same everywhere [m].
    Flat(T),
    /// Slope with rounded corners, level before and after.
    Rise {
        /// Place x at which the rise begins [m].
        start: T,
        /// Length of the rise along x [m].
        length: T,
        /// Height of the rise [m].
        height: T,
        /// Length of each rounded corner, at most half the length [m].
        rounding: T,
    },
    /// Single bump: amplitude (1 - cos(2 pi (x - start) / length)).
    Bump {
        /// Place x at which the bump begins [m].
        start: T,
        /// Length of the bump along x [m].
        length: T,
        /// Half the height of the bump [m].
        amplitude: T,
    },
    /// Natural cubic spline through a range of the knots, level outside.
    Spline(Part),
}

entry!(Feature enum {
    0 Flat { 0 height },
    1 Rise { start start, length length, height height, rounding rounding },
    2 Bump { start start, length length, amplitude amplitude },
    3 Spline { 0 part },
});

/// Height of a road, with its first two derivatives by x.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Height<T> {
    /// Height of the road [m].
    pub value: T,
    /// Slope of the road [-].
    pub slope: T,
    /// Second derivative of the height by x [1/m].
    pub curvature: T,
}

impl<T: Real> Feature<T> {
    /// Height of the feature at `x`, with its derivatives.
    pub(super) fn at(&self, x: T, knots: (&[[T; 2]], &[T])) -> Height<T> {
        match *self {
            Self::Flat(value) => Height { value, ..Height::default() },
            Self::Rise { start, length, height, rounding } => {
                rise([length, height, rounding], x - start)
            }
            Self::Bump { start, length, amplitude } => {
                let u = x - start;
                if !(u > T::ZERO && u < length) {
                    return Height::default();
                }
                let k = T::TWO * T::PI / length;
                let (sin, cos) = (k * u).sin_cos();
                Height {
                    value: amplitude * (T::ONE - cos),
                    slope: amplitude * k * sin,
                    curvature: amplitude * k * k * cos,
                }
            }
            Self::Spline(part) => {
                let m = guide::spline(part.of(knots.0), part.of(knots.1), x);
                Height { value: m.value, slope: m.rate, curvature: m.acceleration }
            }
        }
    }

    /// Places x at which the pieces of the feature meet each other or the level road.
    pub(super) fn ends(&self, knots: (&[[T; 2]], &[T])) -> [Option<T>; 4] {
        match *self {
            Self::Flat(_) => [None; 4],
            Self::Rise { start, length, rounding, .. } => {
                let end = start + length;
                [start, start + rounding, end - rounding, end].map(Some)
            }
            Self::Bump { start, length, .. } => [Some(start), Some(start + length), None, None],
            Self::Spline(part) => {
                let table = part.of(knots.0);
                let ends = [table.first(), table.last()].map(|knot| knot.map(|knot| knot[0]));
                [ends[0], ends[1], None, None]
            }
        }
    }

    /// Upper bound of the second derivative h'' of the height between two places [1/m]; `None` if the feature is level there.
    pub(super) fn hollow(&self, [lower, upper]: [T; 2], knots: (&[[T; 2]], &[T])) -> Option<T> {
        let within = |start: T, length: T| start <= upper && start + length >= lower;
        match *self {
            Self::Flat(_) => None,
            Self::Rise { start, length, height, rounding } => {
                within(start, length).then(|| height.abs() / ((length - rounding) * rounding))
            }
            Self::Bump { start, length, amplitude } => within(start, length).then(|| {
                let k = T::TWO * T::PI / length;
                amplitude.abs() * k * k
            }),
            Self::Spline(part) => spline_hollow(part.of(knots.0), part.of(knots.1), [lower, upper]),
        }
    }
}

/// Largest change of slope at the end of a table that does not count as a hollow [-].
const LEVEL: f64 = 1e-6;

/// Largest curvature of a spline at its knots in a range. If an end of the spline in the range makes a hollow corner with the level
/// road, a very large number is returned.
pub fn spline_hollow<T: Real>(
    table: &[[T; 2]],
    curvatures: &[T],
    [lower, upper]: [T; 2],
) -> Option<T> {
    let (first, last) = (table.first()?[0], table.last()?[0]);
    if !(first <= upper && last >= lower) || table.len() < 2 {
        return None;
    }
    let rise = |x| guide::spline(table, curvatures, x).rate;
    let kink = T::from_f64(LEVEL);
    if (first >= lower && rise(first) > kink) || (last <= upper && rise(last) < -kink) {
        return Some(T::ONE / T::EPSILON);
    }
    let from = table.partition_point(|knot| knot[0] <= lower).saturating_sub(1);
    let to = table.partition_point(|knot| knot[0] < upper) + 1;
    let about = curvatures.get(from..to.min(curvatures.len()))?;
    Some(about.iter().fold(T::ZERO, |most, &c| most.max(c)))
}

/// Height at the distance `u` from the start of a rise, given by length, height and rounding.
fn rise<T: Real>([length, height, rounding]: [T; 3], u: T) -> Height<T> {
    let level = |value| Height { value, ..Height::default() };
    if !(u > T::ZERO) {
        return level(T::ZERO);
    }
    if u >= length {
        return level(height);
    }
    let slope = height / (length - rounding);
    let corner = |u: T| slope * u * u * T::HALF / rounding;
    if u < rounding {
        Height { value: corner(u), slope: slope * u / rounding, curvature: slope / rounding }
    } else if u > length - rounding {
        let rest = length - u;
        Height {
            value: height - corner(rest),
            slope: slope * rest / rounding,
            curvature: -slope / rounding,
        }
    } else {
        Height { value: slope * (u - rounding * T::HALF), slope, curvature: T::ZERO }
    }
}
