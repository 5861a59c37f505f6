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
    /// h_k; zero where there is no road [m].
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

    /// Its rate for the rates of both.
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

#[cfg(all(test, feature = "tire"))]
mod tests {
    extern crate std;

    use super::super::guide::spline_curvatures;
    use super::super::road::Feature;
    use super::super::road_contact::road_contact;
    use super::*;
    use std::vec::Vec;

    fn kinks(features: &[Feature<f64>], knots: (&[[f64; 2]], &[f64])) -> Vec<LawCorner<f64>> {
        let law_inputs = LawInputs { features, knots, ..LawInputs::courses(&[]) };
        let n = u32::try_from(features.len()).expect("a short road");
        let mut all = Vec::new();
        of_road(Part { first: 0, n }, &law_inputs, |kink| all.push(kink));
        all
    }

    #[test]
    fn features_have_kinks_at_their_ends_and_level_ones_have_none() {
        let rise = Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 };
        let bump = Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.05 };
        let all = kinks(&[Feature::Flat(0.1), rise, bump], (&[], &[]));
        let places: Vec<f64> = all.iter().map(|kink| kink.place).collect();
        assert_eq!(places, [1.0, 1.5, 2.5, 3.0, 4.0, 7.0]);
        // The slope of the ramp is 0.3 / 1.5, its corner rises by 0.2 * 0.5 / 2.
        assert!((all[1].slope - 0.2).abs() < 1e-14 && (all[1].height - 0.15).abs() < 1e-15);
        assert!(all[4].slope.abs() < 1e-14 && (all[4].height - 0.4).abs() < 1e-15);
        let flat = Feature::Rise { start: 1.0, length: 2.0, height: 0.0, rounding: 0.5 };
        assert!(kinks(&[flat], (&[], &[])).is_empty());
    }

    #[test]
    fn the_corner_at_an_end_of_a_table_has_two_kinks_on_a_crest_and_one_in_a_hollow() {
        let spline = [Feature::Spline(Part { first: 0, n: 2 })];
        let all = kinks(&spline, (&[[0.0, 0.0], [3.0, 4.0]], &[0.0, 0.0]));
        // Slope 4/3: the halved angle has the tangent (1 - cos) / sin = (1 - 3/5) / (4/5) = 1/2.
        let expected = [(0.0, 0.0, 0.5), (3.0, 4.0, 4.0 / 3.0), (3.0, 4.0, 0.0)];
        assert_eq!(all.len(), 3);
        for (kink, (place, height, slope)) in all.iter().zip(expected) {
            let found = [kink.place - place, kink.height - height, kink.slope - slope];
            assert!(found.iter().all(|x| x.abs() < 1e-14), "{kink:?}");
        }
    }

    #[test]
    fn a_kink_has_the_sign_of_the_foots_way_from_it() {
        let table = [[8.0, 0.0], [8.6, -0.05], [9.2, -0.08], [10.0, -0.1]];
        let (mut curvatures, mut scratch) = ([0.0; 4], [0.0; 4]);
        spline_curvatures(&table, &mut curvatures, &mut scratch);
        let features = [
            Feature::Rise { start: 1.0, length: 2.0, height: 0.6, rounding: 0.5 },
            Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.1 },
            Feature::Spline(Part { first: 0, n: 4 }),
        ];
        let law_inputs = LawInputs {
            features: &features,
            knots: (&table, &curvatures),
            ..LawInputs::courses(&[])
        };
        let road = Part { first: 0, n: 3 };
        let all = kinks(&features, law_inputs.knots());
        // Six of one slope, a crest where the table begins, a hollow where it ends.
        assert_eq!(all.len(), 9);
        let mut passed = 0;
        for i in 0..2200 {
            let x = 0.003 + 0.005 * f64::from(i);
            let center = [x, road::height(road, &law_inputs, x).value + 0.3];
            let at = road_contact(road, &law_inputs, center);
            let u = x - at.normal[0] * at.distance;
            for kink in &all {
                // On a crest the foot stays at the corner, up to rounding; in the hollow h''' moves the jump.
                let g = kink.value(center);
                if (u - kink.place).abs() > 1e-9 && g.abs() > 1e-6 {
                    assert_eq!(g > 0.0, u > kink.place, "{kink:?} from {center:?}");
                    passed += usize::from(g > 0.0);
                }
            }
        }
        assert!(passed > 1000);
    }
}
