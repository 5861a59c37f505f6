//! Rows of what rolls: the lowest point is on the plane, and has the velocity that the plane has there.
//!
//! ```text
//! w = n - a (a·n)      ρ = -R w/|w|      c' + ω₁ × ρ - (velocity of the plane's body there) = s,     u·s = 0
//! ```
//!
//! u is the normal, whose row is the derivative of the height, or lies in the plane and is fixed in its body. A blade has ρ = 0 and
//! u = n × d. Velocities and their derivatives are taken of each body for itself.

use crate::loads::Now;
use crate::rows::{Row, Seat, six};
use crate::scene::{Rolling, Shape};
use crate::vector::{Vector, ZERO, across, add, cross, dot, norm, scale, sub};

/// Lowest point of what rolls: from the centre, and the rate of that.
struct Lowest {
    arm: Vector,
    rate: Vector,
}

/// A direction and its rate.
type Moving = (Vector, Vector);

impl Rolling {
    /// The lowest point of a normal and an axis, each with its rate.
    fn lowest(&self, (n, n_rate): Moving, axis: impl Fn(Vector) -> Moving) -> Lowest {
        let (radius, (a, a_rate)) = match self.shape {
            Shape::Disc(radius, a) => (radius, axis(a)),
            Shape::Ball(radius) => (radius, (ZERO, ZERO)),
            Shape::Blade(_) => return Lowest { arm: ZERO, rate: ZERO },
        };
        let (part, part_rate) = (dot(a, n), dot(a_rate, n) + dot(a, n_rate));
        let w = sub(n, scale(part, a));
        let w_rate = sub(n_rate, add(scale(part_rate, a), scale(part, a_rate)));
        let length = norm(w);
        let along = dot(w, w_rate) / (length * length);
        let rate = scale(-radius / length, sub(w_rate, scale(along, w)));
        Lowest { arm: scale(-radius / length, w), rate }
    }

    /// The point that touches in the reference configuration.
    pub(crate) fn contact(&self) -> Vector {
        add(self.center, self.lowest((self.normal, ZERO), |a| (a, ZERO)).arm)
    }
}

impl Now<'_> {
    /// The rows of what rolls, with their directions on the first body; the height comes first.
    pub(crate) fn rolling(&self, rolling: &Rolling) -> Vec<(Vector, Row)> {
        let [w1, w2] = rolling.bodies.map(|b| self.places.of(b).w);
        let of = |i: usize, w: Vector, v: Vector| {
            let v = self.places.direction(rolling.bodies[i], v);
            (v, cross(w, v))
        };
        let normal = of(1, w2, rolling.normal);
        let center = self.places.seat(rolling.bodies[0], rolling.center);
        let lowest = rolling.lowest(normal, |a| of(0, w1, a));
        let place = add(center.p, lowest.arm);
        let height =
            dot(normal.0, sub(place, self.places.seat(rolling.bodies[1], rolling.point).p));
        let row = |u: Moving| self.slip(rolling, &center, &lowest, u);
        if let Shape::Blade(d) = rolling.shape {
            let (d, d_rate) = of(0, w1, d);
            let u = cross(normal.0, d);
            let u_rate = add(cross(normal.1, d), cross(normal.0, d_rate));
            return vec![(u, rated(row((u, u_rate))))];
        }
        let sides = if self.scene.planar {
            vec![cross([0.0, 0.0, 1.0], rolling.normal)]
        } else {
            across(rolling.normal).to_vec()
        };
        let mut rows = vec![(normal.0, row(normal).with_value(height))];
        for side in sides {
            let side = of(1, w2, side);
            rows.push((side.0, rated(row(side))));
        }
        rows
    }

    /// u · s with its gradient and the part of its derivative without accelerations.
    fn slip(&self, rolling: &Rolling, center: &Seat, lowest: &Lowest, (u, u_rate): Moving) -> Row {
        let [one, two] = rolling.bodies.map(|b| *self.places.of(b));
        let arm = add(center.arm, lowest.arm);
        let place = add(center.p, lowest.arm);
        let other_arm = sub(place, two.r);
        let slip = sub(add(one.v, cross(one.w, arm)), add(two.v, cross(two.w, other_arm)));
        // ω × d/dt of each arm
        let place_rate = add(center.v, lowest.rate);
        let first = add(center.bias, cross(one.w, lowest.rate));
        let second = cross(two.w, sub(place_rate, two.v));
        let bias = dot(u_rate, slip) + dot(u, sub(first, second));
        let parts = vec![
            (rolling.bodies[0], six(u, cross(arm, u))),
            (rolling.bodies[1], six(scale(-1.0, u), scale(-1.0, cross(other_arm, u)))),
        ];
        Row::new(parts, 0.0, bias)
    }
}

/// A row that holds rates alone.
fn rated(row: Row) -> Row {
    Row { of_rates: true, ..row }
}
