//! The nearest point of a road to the centre of a wheel.
//!
//! ```text
//! foot    u where D = ((u - x)^2 + (h(u) - z)^2)/2 is least,   D' = (u - x) + (h(u) - z) h'(u) = 0
//! normal  n = (-h', 1) / sqrt(1 + h'^2),   distance d = n.(c - foot)
//! turn    dn/ds = -kappa / (1 - kappa d),   kappa = h'' / (1 + h'^2)^(3/2)       s the centre's way along the road
//! ```
//!
//! The distance to the nearest point has the normal as its gradient, so that a force by distance along the normal has a
//! potential on every road.
//!
//! **What is found.** Newton's method on D', kept within a bracket that holds a minimum of D, starts from the point below the
//! centre and ends in a stationary point, always one at least as near as that start. Where h'' d < 1 holds over the reach of
//! the centre, h'' bounded by the sum over the road's parts, that point is the nearest. The circle of radius d about the
//! centre, which touches the road there, is rounder than the road everywhere, so that the road stays below it. Scenes are
//! refused whose features break h'' R < 1, so this covers every wheel that is pressed in, one feature at a time.
//!
//! Elsewhere, which is in hollows as tight as the wheel and where a centre is far above a road, the road within the distance
//! already found is divided into [`CELLS`] equal cells. Every cell at whose ends the distance shows a minimum within is
//! searched, and the nearest of all is taken. A second minimum inside one cell (an eighth of the distance) may be missed. So may
//! what the last cells show where the first took all of the steps that they share ([`most_heights`]).
//!
//! **Two points equally near.** The nearest point, and with it the direction of the force, jumps where the centre crosses the
//! middle between two points that are equally near. Distance and force stay continuous in size. Equally near ones are
//! decided for the one found first. A wheel that rests in a hollow tighter than itself sits on such a jump: one force stands
//! for two, and alternates.
//!
//! A crest that is sharp, at the end of a table, is the nearest point to all centres in a wedge above it: there the normal
//! points to the centre.

use super::road::{self, Height};
use super::{LawInputs, Part};
use crate::Real;

/// The nearest point of a road, as seen from a centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoadContact<T> {
    /// Distance, negative below the road [m].
    pub distance: T,
    /// Unit normal of the road there: along x, and up.
    pub normal: [T; 2],
    /// Second derivative h'' of the height there; on a sharp crest so far below zero that [`turn`](Self::turn) is that of a point [1/m].
    pub bend: T,
}

/// Newton steps and bisections of one search at most: as many as the number has bits, and some.
const fn steps<T: Real>() -> usize {
    // Sizes distinguish precisions where a number is not compared yet.
    if size_of::<T>() == 4 { 32 } else { 64 }
}

/// Heights that [`road_contact`] asks for at most: below the centre, in one search, at the ends of all cells, and in as many steps as two
/// searches have, which the cells share.
#[must_use]
pub const fn most_heights<T: Real>() -> usize {
    1 + steps::<T>() + 1 + CELLS as usize + 2 * steps::<T>()
}

/// Cells that the reach of a centre is divided into where one search does not suffice [-]. A second minimum inside one, an eighth of
/// the distance wide, may be missed; each costs a height. Chosen, not tuned.
pub const CELLS: u32 = 16;

/// The nearest point to (x, z) [m]. Cost: one height where the road is level within the centre's height above it, a few on
/// slopes; where the point is not surely the nearest, about forty.
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
    /// Rate at which the normal turns as the centre moves along the road by its tangent (normal_up, -normal_x) [1/m]. In a hollow it
    /// grows without bound where the centre comes to the centre of curvature; it is cut off at a hundred times h''.
    pub fn turn(&self) -> T {
        /// Least distance to the centre of curvature, relative to its radius [-]. Chosen, not tuned.
        const LEAST_DISTANCE: f64 = 0.01;
        let up = self.normal[1];
        let kappa = self.bend * up * up * up;
        -kappa / (T::ONE - kappa * self.distance).max(T::from_f64(LEAST_DISTANCE))
    }
}

/// Data that all searches of one centre share.
struct Search<'a, T> {
    road: Part,
    law_inputs: &'a LawInputs<'a, T>,
    center: [T; 2],
    /// Rounding of D' [m], and of D [m^2].
    goal: T,
    slack: T,
}

/// A place of the road.
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

    /// A minimum of D between `near`, from which D falls towards `far`, and `far`, where it has risen or rises again; steps come off `left`.
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

    /// Divisor of Newton's step: the second derivative D'' of half the squared distance. Where it is small or negative, the value for a
    /// straight road of the same slope.
    fn pivot(&self, height: &Height<T>) -> T {
        /// Least D'', relative to that of a straight road [-]: steps are at most ten times as long. Chosen, not tuned.
        const LEAST_PIVOT: f64 = 0.1;
        let steep = T::ONE + height.slope * height.slope;
        let full = steep - (self.center[1] - height.value) * height.curvature;
        if full > steep * T::from_f64(LEAST_PIVOT) { full } else { steep }
    }

    /// The nearest of all minima that cells within `distance` show, `best` among them.
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
                // A cell may begin in a minimum, and another follow.
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
            // A sharp crest: nowhere near it does D' vanish.
            let signed = if to_center[1] < T::ZERO { -length } else { length };
            normal = to_center.map(|x| x / signed);
            bend = -T::ONE / (T::EPSILON * length);
        }
        let distance = normal[0] * to_center[0] + normal[1] * to_center[1];
        RoadContact { distance, normal, bend }
    }
}
