//! Nearest point of a road to the centre of a wheel.
//!
//! ```text
//! foot    u where D = ((u - x)^2 + (h(u) - z)^2)/2 is least,   D' = (u - x) + (h(u) - z) h'(u) = 0      centre c = (x, z), height h
//! normal  n = (-h', 1) / sqrt(1 + h'^2),   distance d = n.(c - foot)
//! turn    dn/ds = -kappa / (1 - kappa d),   kappa = h'' / (1 + h'^2)^(3/2)       s: path of the centre along the road
//! ```
//!
//! The gradient of the distance to the nearest point is the normal. So a force along the normal that depends on the distance has a
//! potential on every road.
//!
//! **Result.** Newton's method solves D' = 0 within a bracket that contains a minimum of D. It starts from the point of the road
//! below the centre. It ends in a stationary point that is at least as near to the centre as the start. This point is the nearest
//! if h'' d < 1 within the reach of the centre. The proof: the circle of radius d about the centre touches the road there. It is
//! more curved than the road everywhere, so that the road stays below it. The bound of h'' is the sum of the bounds of the road's
//! features. Scenes are refused if a feature violates h'' R < 1 for a wheel of radius R. So the condition holds for every wheel
//! that is pressed in, if features do not overlap.
//!
//! The condition fails in hollows as tight as the wheel, and for a centre far above a road. The road within the distance found so
//! far is then divided into [`CELLS`] equal cells. Every cell whose ends show a minimum inside is searched, and the nearest minimum
//! is used. A second minimum inside one cell (an eighth of the distance) may be missed. Minima in the last cells may also be
//! missed, if the first cells used all steps that the cells share ([`most_heights`]).
//!
//! **Two nearest points.** The nearest point and the direction of the force jump if the centre crosses the line of equal distance
//! from two points. The distance and the size of the force stay continuous. Of two equally near points the first found is used. A
//! wheel at rest in a hollow tighter than itself is at such a jump. One force then replaces two, and alternates between the two
//! points.
//!
//! A sharp crest, at the end of a table, is the nearest point for all centres in a wedge above it. The normal there points to the
//! centre.

use super::road::{self, Height};
use super::{LawInputs, Part};
use crate::Real;

/// Nearest point of a road, as seen from a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoadContact<T> {
    /// Distance, negative below the road [m].
    pub distance: T,
    /// Unit normal of the road at the nearest point: along x, and up.
    pub normal: [T; 2],
    /// Second derivative h'' of the height at the nearest point [1/m]. On a sharp crest it is a large negative number, so that
    /// [`turn`](Self::turn) is 1 / distance, as for a single point.
    pub bend: T,
}

/// Largest number of Newton steps and bisections of one search: the number of bits of `T`, plus a few.
const fn steps<T: Real>() -> usize {
    // The size of `T` distinguishes precisions in a constant function, which cannot compare numbers.
    if size_of::<T>() == 4 { 32 } else { 64 }
}

/// Largest number of heights that [`road_contact`] computes: below the centre, in one search, and at the ends of all cells. The
/// searches in the cells share as many steps as two searches have.
#[must_use]
pub const fn most_heights<T: Real>() -> usize {
    1 + steps::<T>() + 1 + CELLS as usize + 2 * steps::<T>()
}

/// Number of cells for the reach of a centre, if one search is not enough [-]. Each costs a height. A second minimum within one
/// cell, an eighth of the distance wide, may be missed. Chosen, not tuned.
pub const CELLS: u32 = 16;

/// Finds the point of a road nearest to (x, z) [m]. Cost: one height if the road is level within the centre's height above it, and
/// a few heights on slopes. If the point found is not certainly the nearest, about forty heights are computed.
#[inline]
pub fn road_contact<T: Real>(
    road: Part,
    law_inputs: &LawInputs<'_, T>,
    [x, z]: [T; 2],
) -> RoadContact<T> {
    let below = road::height(road, law_inputs, x);
    let above = z - below.value;
    let reach = above.abs();
    let Some(hollow) = road::hollow(road, law_inputs, [x - reach, x + reach]) else {
        return RoadContact { distance: above, normal: [T::ZERO, T::ONE], bend: T::ZERO };
    };
    let goal = T::EPSILON * T::from_f64(4.0) * (reach + x.abs() + z.abs());
    let search = Search { road, law_inputs, center: [x, z], goal, slack: T::TWO * goal * reach };
    let start = search.spot(x, below);
    let side = if start.slope > T::ZERO { -reach } else { reach };
    let near = search.settle(start, x + side, &mut steps::<T>());
    let distance = (near.square + near.square).sqrt();
    if above > T::ZERO && hollow * distance < T::ONE {
        return search.foot(&near);
    }
    search.foot(&search.among(near, distance))
}

impl<T: Real> RoadContact<T> {
    /// Rate at which the normal rotates as the centre moves along the tangent (normal_up, -normal_x) [1/m]. In a hollow it grows
    /// without bound as the centre approaches the centre of curvature. It is limited to a hundred times h''.
    pub fn turn(&self) -> T {
        /// Least distance to the centre of curvature, relative to its radius [-]. Chosen, not tuned.
        const LEAST_DISTANCE: f64 = 0.01;
        let up = self.normal[1];
        let kappa = self.bend * up * up * up;
        -kappa / (T::ONE - kappa * self.distance).max(T::from_f64(LEAST_DISTANCE))
    }
}

/// Data that the searches for one centre share.
struct Search<'a, T> {
    road: Part,
    law_inputs: &'a LawInputs<'a, T>,
    center: [T; 2],
    /// Rounding error that is allowed for D' [m] and for D [m^2].
    goal: T,
    slack: T,
}

/// Point of the road, with D and D' there.
#[derive(Debug, Clone, Copy)]
struct Spot<T> {
    u: T,
    height: Height<T>,
    /// D [m^2] and D' [m].
    square: T,
    slope: T,
}

impl<T: Real> Search<'_, T> {
    fn at(&self, u: T) -> Spot<T> {
        self.spot(u, road::height(self.road, self.law_inputs, u))
    }

    fn spot(&self, u: T, height: Height<T>) -> Spot<T> {
        let (along, above) = (u - self.center[0], self.center[1] - height.value);
        let square = (along * along + above * above) * T::HALF;
        Spot { u, height, square, slope: along - above * height.slope }
    }

    /// Finds a minimum of D between `near` and `far`. From `near` D falls towards `far`, and at `far` it has risen or rises again.
    /// `left` is the number of steps that remain, and is reduced.
    fn settle(&self, mut near: Spot<T>, mut far: T, left: &mut usize) -> Spot<T> {
        let forward = far > near.u;
        let mut last = near;
        let (mut step, mut before) = ((far - near.u).abs(), (far - near.u).abs());
        for _ in 0..steps::<T>().min(*left) {
            if last.slope.abs() <= self.goal {
                break;
            }
            let newton = last.u - last.slope / self.pivot(&last.height);
            let is_within = if forward {
                newton > near.u && newton < far
            } else {
                newton < near.u && newton > far
            };
            let is_small = (newton - last.u).abs() <= before * T::HALF;
            let u = if is_within && is_small { newton } else { (near.u + far) * T::HALF };
            if u == near.u || u == far {
                break;
            }
            (before, step) = (step, (u - last.u).abs());
            *left -= 1;
            last = self.at(u);
            let falls_on = (last.slope < T::ZERO) == forward;
            if falls_on && last.square <= near.square + self.slack {
                near = last;
            } else {
                far = u;
            }
        }
        last
    }

    /// Divisor of Newton's step: the second derivative D'' of half the squared distance. If D'' is small or negative, the D'' of a
    /// straight road of the same slope is used.
    fn pivot(&self, height: &Height<T>) -> T {
        /// Least D'', relative to that of a straight road [-]: steps are at most ten times as long. Chosen, not tuned.
        const LEAST_PIVOT: f64 = 0.1;
        let steep = T::ONE + height.slope * height.slope;
        let full = steep - (self.center[1] - height.value) * height.curvature;
        if full > steep * T::from_f64(LEAST_PIVOT) { full } else { steep }
    }

    /// Nearest point among `best` and all minima in the cells within `distance`.
    fn among(&self, mut best: Spot<T>, distance: T) -> Spot<T> {
        let width = T::TWO * distance / T::from_f64(f64::from(CELLS));
        let mut left = self.at(self.center[0] - distance);
        let mut shared = 2 * steps::<T>();
        for _ in 0..CELLS {
            let right = self.at(left.u + width);
            let (falls, rises) = (left.slope < -self.goal, right.slope > self.goal);
            let found = if falls && (rises || right.square >= left.square) {
                Some(self.settle(left, right.u, &mut shared))
            } else if rises && left.square >= right.square {
                Some(self.settle(right, left.u, &mut shared))
            } else {
                // A cell may begin at a minimum and contain another one.
                (left.slope.abs() <= self.goal).then_some(left)
            };
            if let Some(found) = found
                && found.square < best.square - self.slack
            {
                best = found;
            }
            left = right;
        }
        best
    }

    fn foot(&self, spot: &Spot<T>) -> RoadContact<T> {
        let Height { value, slope, curvature } = spot.height;
        let inverse = T::ONE / (T::ONE + slope * slope).sqrt();
        let (mut normal, mut bend) = ([-slope * inverse, inverse], curvature);
        let to_center = [self.center[0] - spot.u, self.center[1] - value];
        let length = (spot.square + spot.square).sqrt();
        if spot.slope.abs() > T::EPSILON.sqrt() * length {
            // At a sharp crest D' does not vanish.
            let signed = if to_center[1] < T::ZERO { -length } else { length };
            normal = to_center.map(|x| x / signed);
            bend = -T::ONE / (T::EPSILON * length);
        }
        let distance = normal[0] * to_center[0] + normal[1] * to_center[1];
        RoadContact { distance, normal, bend }
    }
}
