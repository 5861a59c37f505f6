//! Kinks: places at which a law passes from one smooth piece to the next, each with a coordinate that is zero there.
//!
//! ```text
//! road         g = (x - x_k) + (z - h_k) h'_k        x, z the wheel's centre over the road: the foot is at x_k where g = 0
//! polynomial   g = m - m_k
//! ```
//!
//! g is -D' of the foot at x_k: where D has one minimum within a wheel's reach, the foot lies right of x_k where g > 0.
//! The foot's coordinate would do as well, but its rate jumps where the road's curvature does. g is linear in the centre, so
//! that it is as smooth as the motion and can be interpolated through the kink. Where D has more than one, in hollows about as
//! tight as the wheel, a kink beside the foot may be found, and a step end there in vain.
//!
//! A table may end in a slope, and the road has a corner there. On a crest the foot rests at the corner while the centre
//! passes between the two normals: two kinks. In a hollow it jumps from one side to the other where both are equally near. That
//! is one kink, on the line that halves the angle. The road beside it is taken as straight, which an end of a spline is but for h'''.

use super::{LawInputs, Part, road};
use crate::Real;

/// A place where a law has a kink.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawCorner<T> {
    /// x_k, over the road, or m_k [m or rad].
    pub place: T,
    /// Height h_k of the road; zero where there is no road [m].
    pub height: T,
    /// h'_k, or the slope whose normal is passed [-].
    pub slope: T,
}

impl<T: Real> LawCorner<T> {
    /// g at (x, z), or at (m, 0).
    #[inline]
    pub fn value(&self, [x, z]: [T; 2]) -> T {
        (x - self.place) + (z - self.height) * self.slope
    }

    /// Rate of g for the rates of both coordinates.
    #[inline]
    pub fn rate(&self, [x, z]: [T; 2]) -> T {
        x + z * self.slope
    }
}

/// Largest jump that counts as none, of the slope [-] and the curvature [1/m]. Chosen, not tuned.
const MAX_JUMP: f64 = 1e-6;

/// Hands out the places where slope or curvature of a road jump, feature by feature.
///
/// Cost: three heights of the road for each end of a feature; once for a run.
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
    // Both sides, a little more than rounding away.
    let aside = T::EPSILON * T::from_f64(8.0) * (T::ONE + place.abs());
    let [left, right] = [place - aside, place + aside].map(|x| road::height(road, law_inputs, x));
    let level = T::from_f64(MAX_JUMP);
    let bent = (right.curvature - left.curvature).abs() > level;
    let smooth = (left.curvature.abs() + right.curvature.abs()) * aside;
    let turn = right.slope - left.slope;
    let here = road::height(road, law_inputs, place);
    let mut kink = |slope| take(LawCorner { place, height: here.value, slope });
    if turn > level + smooth {
        // n_left.(c - k) = n_right.(c - k),   n = (-h', 1) / w
        let [l, r] = [left, right].map(|h| T::ONE / (T::ONE + h.slope * h.slope).sqrt());
        kink((l - r) / (right.slope * r - left.slope * l));
    } else if -turn > level + smooth {
        kink(left.slope);
        kink(right.slope);
    } else if bent {
        kink(here.slope);
    }
}
