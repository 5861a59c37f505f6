//! Roads: heights over x, the same across it, and the nearest point of a road to the centre of a wheel.
//!
//! ```text
//! rise    slope 0 -> s -> 0, linear over the rounding r at both ends, s = height / (length - r)
//! bump    A (1 - cos(2 pi (x - x0) / L))
//! foot    u with (u - x) + (h(u) - z) h'(u) = 0,   distance n.(c - foot), normal n = (-h', 1) / sqrt(1 + h'^2)
//! ```
//!
//! The distance to the nearest point has the normal as its gradient, so that a force by distance along the normal has a
//! potential on every road. The foot is unique while hollows are rounder than the wheel: h'' (R - deflection) < 1.

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
    for feature in road.of(supplies.features) {
        let h = feature.at(x, supplies.knots);
        sum.value += h.value;
        sum.slope += h.slope;
        sum.curvature += h.curvature;
    }
    sum
}

/// The nearest point of a road, as seen from a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foot<T> {
    /// Distance, negative below the road [m].
    pub distance: T,
    /// Unit normal of the road there: along x, and up.
    pub normal: [T; 2],
}

/// Newton steps that the foot may take; hollows as tight as the wheel may end before.
const STEPS: usize = 20;

/// The nearest point to (x, z) [m]. Cost: one height on level ground, a few on slopes.
pub fn foot<T: Real>(road: Part, supplies: &Supplies<'_, T>, [x, z]: [T; 2]) -> Foot<T> {
    let mut u = x;
    let mut h = height(road, supplies, u);
    let goal = T::EPSILON * T::from_f64(4.0);
    for _ in 0..STEPS {
        let above = z - h.value;
        let residual = u - x - above * h.slope;
        if residual.abs() <= goal * (above.abs() + x.abs()) {
            break;
        }
        let steep = T::ONE + h.slope * h.slope;
        // Where the road is hollow the full slope may vanish: then the step of a straight road is taken.
        let full = steep - above * h.curvature;
        let pivot = if full > steep * T::from_f64(0.1) { full } else { steep };
        u -= residual / pivot;
        h = height(road, supplies, u);
    }
    let inverse = T::ONE / (T::ONE + h.slope * h.slope).sqrt();
    let normal = [-h.slope * inverse, inverse];
    Foot { distance: normal[0] * (x - u) + normal[1] * (z - h.value), normal }
}

#[cfg(test)]
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
    fn the_normal_is_the_gradient_of_the_distance() {
        let (road, s) = supplies();
        let step = 1e-6;
        for i in 0..80 {
            let c = [0.1 * f64::from(i), 0.8];
            let distance = |dx: f64, dz: f64| foot(road, &s, [c[0] + dx, c[1] + dz]).distance;
            let at = foot(road, &s, c);
            let by = [
                (distance(step, 0.0) - distance(-step, 0.0)) / (2.0 * step),
                (distance(0.0, step) - distance(0.0, -step)) / (2.0 * step),
            ];
            // The curvature jumps at corners, so that second differences are of the order of the step.
            assert!((by[0] - at.normal[0]).abs() < 1e-5 && (by[1] - at.normal[1]).abs() < 1e-5);
        }
    }

    #[test]
    fn on_a_straight_slope_the_distance_is_that_of_a_line() {
        let (road, s) = supplies();
        let (x, z) = (2.0, 0.7);
        let at = foot(road, &s, [x, z]);
        // Height 0.25 and slope 0.2 in the middle.
        let expected = (z - 0.25) / 1.04_f64.sqrt();
        assert!((at.distance - expected).abs() < 1e-14);
    }
}
