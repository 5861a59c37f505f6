//! Rows of rolling contacts: the lowest point of the body is on the plane and has the velocity of the plane there.
//!
//! ```text
//! w = n - a (a·n)      ρ = -R w/|w|      c' + ω₁ × ρ - (velocity of the plane's body there) = s,     u·s = 0
//! ```
//!
//! Here a is the axis of the disc, n the plane's normal, R the radius, and ρ the arm from the centre c to the lowest point. The body has
//! the angular velocity ω₁, and s is the slip velocity. The direction u is the normal, or it is in the plane and fixed in its body. The row
//! of the normal is the derivative of the height. A blade along d has ρ = 0 and u = n × d.

use crate::loads::Now;
use crate::rows::{Row, Seat, six};
use crate::scene::{Rolling, Shape};
use crate::vector::{Vector, ZERO, across, add, cross, dot, norm, scale, sub};

/// Lowest point of a rolling body: its arm from the centre, and the rate of the arm.
struct Lowest {
    arm: Vector,
    rate: Vector,
}

/// A direction and its rate.
type Moving = (Vector, Vector);

impl Rolling {
    /// The lowest point for a normal of the plane and an axis of the body, each with its rate.
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

    /// The contact point in the reference configuration.
    pub(crate) fn contact(&self) -> Vector {
        add(self.center, self.lowest((self.normal, ZERO), |a| (a, ZERO)).arm)
    }
}

impl Now<'_> {
    /// The rows of a rolling contact, each with the direction of its force on the first body. The height is the first row.
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

    /// Row of u · s, with its gradient and its bias: the derivative without accelerations.
    fn slip(&self, rolling: &Rolling, center: &Seat, lowest: &Lowest, (u, u_rate): Moving) -> Row {
        let [one, two] = rolling.bodies.map(|b| *self.places.of(b));
        let arm = add(center.arm, lowest.arm);
        let place = add(center.p, lowest.arm);
        let other_arm = sub(place, two.r);
        let slip = sub(add(one.v, cross(one.w, arm)), add(two.v, cross(two.w, other_arm)));
        // the rates of both arms, crossed with the angular velocities
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

/// Marks a row that constrains rates alone.
fn rated(row: Row) -> Row {
    Row { of_rates: true, ..row }
}
