//! Roads: heights over x, the same across it.
//!
//! ```text
//! rise    slope 0 -> s -> 0, linear over the rounding r at both ends, s = height / (length - r)
//! bump    A (1 - cos(2 pi (x - x0) / L))
//! ```

use super::entry::entry;
use super::{Part, Supplies, guide};
use crate::Real;

/// A part of a road; heights of all parts add up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Feature<T> {
    /// The same height everywhere [m].
    Flat(T),
    /// A slope with rounded corners, level before and after.
    Rise {
        /// Where it begins [m].
        start: T,
        /// Its length along x [m].
        length: T,
        /// Its height [m].
        height: T,
        /// Length of each rounded corner, at most half the length [m].
        rounding: T,
    },
    /// amplitude (1 - cos(2 pi (x - start) / length)), once.
    Bump {
        /// Where it begins [m].
        start: T,
        /// Its length along x [m].
        length: T,
        /// Half its height [m].
        amplitude: T,
    },
    /// Natural cubic spline through a part of the knots, level outside.
    Spline(Part),
}

entry!(Feature enum {
    0 Flat { 0 height },
    1 Rise { start start, length length, height height, rounding rounding },
    2 Bump { start start, length length, amplitude amplitude },
    3 Spline { 0 part },
});

/// A height and its first two derivatives by x.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Height<T> {
    /// [m].
    pub value: T,
    /// [-].
    pub slope: T,
    /// [1/m].
    pub curvature: T,
}

impl<T: Real> Feature<T> {
    /// The height at `x`.
    fn at(&self, x: T, knots: (&[[T; 2]], &[T])) -> Height<T> {
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

    /// Where its pieces meet, each other or the level road.
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

    /// A bound of h'' between two places; `None`: level there.
    fn hollow(&self, [lower, upper]: [T; 2], knots: (&[[T; 2]], &[T])) -> Option<T> {
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

/// Largest slope at the end of a table that makes no hollow with the level road beyond it [-]. Chosen, not tuned.
const LEVEL_SLOPE: f64 = 1e-6;

/// The largest curvature of the knots about a range; where the table rises from its end there, a bound that none exceeds.
fn spline_hollow<T: Real>(table: &[[T; 2]], curvatures: &[T], [lower, upper]: [T; 2]) -> Option<T> {
    let (first, last) = (table.first()?[0], table.last()?[0]);
    if !(first <= upper && last >= lower) || table.len() < 2 {
        return None;
    }
    let rise = |x| guide::spline(table, curvatures, x).rate;
    let kink = T::from_f64(LEVEL_SLOPE);
    if (first >= lower && rise(first) > kink) || (last <= upper && rise(last) < -kink) {
        return Some(T::ONE / T::EPSILON);
    }
    let from = table.partition_point(|knot| knot[0] <= lower).saturating_sub(1);
    let to = table.partition_point(|knot| knot[0] < upper) + 1;
    let about = curvatures.get(from..to.min(curvatures.len()))?;
    Some(about.iter().fold(T::ZERO, |most, &c| most.max(c)))
}

/// A rise of length, height and rounding at the distance `u` from its start.
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

/// Height of a road at `x`.
pub fn height<T: Real>(road: Part, supplies: &Supplies<'_, T>, x: T) -> Height<T> {
    let mut sum = Height::default();
    for feature in road.of(supplies.features()) {
        let h = feature.at(x, supplies.knots());
        sum.value += h.value;
        sum.slope += h.slope;
        sum.curvature += h.curvature;
    }
    sum
}

/// The largest h'' [1/m] of a road between `lower` and `upper`, or a bound of it; `None` where it is level there.
///
/// Cost: a few operations for each part of the road, and for the knots of a spline that lie there.
pub fn hollow<T: Real>(
    road: Part,
    supplies: &Supplies<'_, T>,
    [lower, upper]: [T; 2],
) -> Option<T> {
    let mut sum = None;
    for feature in road.of(supplies.features()) {
        if let Some(hollow) = feature.hollow([lower, upper], supplies.knots()) {
            sum = Some(sum.unwrap_or(T::ZERO) + hollow);
        }
    }
    sum
}

#[cfg(all(test, feature = "tire"))]
mod tests {
    use super::*;

    const ROAD: [Feature<f64>; 3] = [
        Feature::Flat(0.1),
        Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 },
        Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.05 },
    ];

    fn supplies() -> (Part, Supplies<'static, f64>) {
        let supplies = Supplies { features: &ROAD, ..Supplies::courses(&[]) };
        (Part { first: 0, n: 3 }, supplies)
    }

    #[test]
    fn slope_and_curvature_are_derivatives_of_the_height() {
        let (road, s) = supplies();
        let step = 1e-6;
        for i in 0..90 {
            let x = 0.013 + 0.1 * f64::from(i);
            let (a, h, b) =
                (height(road, &s, x - step), height(road, &s, x), height(road, &s, x + step));
            assert!(((b.value - a.value) / (2.0 * step) - h.slope).abs() < 1e-8, "{x}");
            assert!(((b.slope - a.slope) / (2.0 * step) - h.curvature).abs() < 1e-6, "{x}");
        }
        assert!((height(road, &s, 0.0).value - 0.1).abs() < 1e-15);
        assert!((height(road, &s, 3.5).value - 0.4).abs() < 1e-15);
        assert!((height(road, &s, 5.5).value - 0.5).abs() < 1e-15);
    }

    #[test]
    fn the_bound_of_a_hollow_holds_where_a_road_bends_and_level_parts_have_none() {
        let (road, s) = supplies();
        for i in 0..90 {
            let x = 0.013 + 0.1 * f64::from(i);
            match hollow(road, &s, [x - 0.02, x + 0.02]) {
                Some(bound) => assert!(height(road, &s, x).curvature <= bound, "{x}"),
                None => assert!(height(road, &s, x).slope == 0.0, "{x}"),
            }
        }
        assert_eq!(hollow(road, &s, [0.0, 0.9]), None);
        assert_eq!(hollow(road, &s, [3.1, 3.9]), None);
    }

    #[test]
    fn a_table_is_as_hollow_as_its_knots_and_has_no_bound_where_it_rises_from_its_end() {
        let table = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.0], [3.0, 0.1], [4.0, 0.0]];
        let (mut curvatures, mut scratch) = ([0.0; 5], [0.0; 5]);
        guide::spline_curvatures(&table, &mut curvatures, &mut scratch);
        let of = |x| spline_hollow(&table, &curvatures, x);
        assert_eq!(of([-2.0, -0.1]), None);
        assert_eq!(of([4.1, 9.0]), None);
        assert_eq!(of([1.2, 1.8]), Some(curvatures[2]));
        assert_eq!(of([1.2, 2.8]), Some(curvatures[2]));
        assert!(of([-0.1, 0.1]) > Some(1e9) && of([3.9, 4.2]) > Some(1e9));
    }
}
