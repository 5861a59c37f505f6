//! Kinks: places at which a law changes from one smooth piece to the next. The coordinate g of a kink is zero there.
//!
//! ```text
//! road         g = (x - x_k) + (z - h_k) h'_k        x, z: centre of the wheel over the road; the nearest point is at x_k where g = 0
//! polynomial   g = m - m_k                           m: measured value
//! ```
//!
//! For the point x_k of the road, g is -D', where D is half the squared distance between this point and the centre. If D has one
//! minimum within a wheel's reach, the nearest point is right of x_k for g > 0. The coordinate of the nearest point itself is not
//! used as g, because its rate jumps where the road's curvature jumps. The function g is linear in the centre. So g is as smooth as
//! the motion, and can be interpolated across the kink. In a hollow about as tight as the wheel, D has several minima. A kink
//! beside the nearest point may then be found, and a step may end there without need.
//!
//! A table may end with a slope, and the road then has a corner there. On a crest the nearest point stays at the corner while the
//! centre passes between the two normals of the corner. Each normal is a kink. In a hollow the nearest point jumps from one side to
//! the other where both sides are equally near. This is one kink, on the bisector of the angle. The road beside the corner is taken
//! as straight, which neglects the third derivative h''' of a spline.

use super::{LawInputs, Part, road};
use crate::Real;

/// Place at which a law has a kink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawCorner<T> {
    /// Place x_k on the road, or value m_k [m or rad].
    pub place: T,
    /// Height h_k of the road [m]; zero for laws without a road.
    pub height: T,
    /// Slope h'_k [-]; at a corner, the slope of the normal that the centre crosses.
    pub slope: T,
}

impl<T: Real> LawCorner<T> {
    /// Coordinate g at the centre (x, z), or at (m, 0).
    #[inline]
    pub fn value(&self, [x, z]: [T; 2]) -> T {
        (x - self.place) + (z - self.height) * self.slope
    }

    /// Rate of g, from the rates of both coordinates.
    #[inline]
    pub fn rate(&self, [x, z]: [T; 2]) -> T {
        x + z * self.slope
    }
}

/// Largest jump of the slope [-] and of the curvature [1/m] that does not count as a kink. Chosen, not tuned.
const MAX_JUMP: f64 = 1e-6;

/// Passes the kinks of a road to `take`: places where its slope or curvature jumps, feature by feature.
///
/// Cost: three heights of the road for each end of a feature. A run does this once.
pub fn of_road<T: Real>(
    road: Part,
    law_inputs: &LawInputs<'_, T>,
    mut take: impl FnMut(LawCorner<T>),
) {
    for feature in road.of(law_inputs.features()) {
        for place in feature.ends(law_inputs.knots()).into_iter().flatten() {
            of_place(road, law_inputs, place, &mut take);
        }
    }
}

fn of_place<T: Real>(
    road: Part,
    law_inputs: &LawInputs<'_, T>,
    place: T,
    take: &mut impl FnMut(LawCorner<T>),
) {
    // Points on both sides of the place, at a distance a little above rounding.
    let aside = T::EPSILON * T::from_f64(8.0) * (T::ONE + place.abs());
    let [left, right] = [place - aside, place + aside].map(|x| road::height(road, law_inputs, x));
    let level = T::from_f64(MAX_JUMP);
    let bent = (right.curvature - left.curvature).abs() > level;
    let smooth = (left.curvature.abs() + right.curvature.abs()) * aside;
    let turn = right.slope - left.slope;
    let here = road::height(road, law_inputs, place);
    let mut kink = |slope| take(LawCorner { place, height: here.value, slope });
    if turn > level + smooth {
        // the bisector: n_left.(c - k) = n_right.(c - k),   n = (-h', 1) / w, c: centre, k: corner
        let [l, r] = [left, right].map(|h| T::ONE / (T::ONE + h.slope * h.slope).sqrt());
        kink((l - r) / (right.slope * r - left.slope * l));
    } else if -turn > level + smooth {
        kink(left.slope);
        kink(right.slope);
    } else if bent {
        kink(here.slope);
    }
}
