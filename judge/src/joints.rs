//! Rows of each kind of joint: its constraints and its coordinates.

use crate::rows::{Places, Row, Seat};
use crate::scene::{Carrier, Joint, Kind};
use crate::vector::{
    Vector, across, add, compose, conjugate, cross, dot, logarithm, norm, scale, sub, unit,
};
use core::ops::Range;

const EX: Vector = [1.0, 0.0, 0.0];
const EY: Vector = [0.0, 1.0, 0.0];
const EZ: Vector = [0.0, 0.0, 1.0];

impl Joint {
    pub(crate) fn seats(&self, places: &Places) -> [Seat; 2] {
        [0, 1].map(|i| places.seat(self.bodies[i], self.points[i]))
    }

    fn coincidence(&self, places: &Places, planar: bool) -> Vec<Row> {
        let seats = self.seats(places);
        let axes: &[Vector] = if planar { &[EX, EY] } else { &[EX, EY, EZ] };
        axes.iter().map(|&e| places.along(self.bodies, &seats, e, false)).collect()
    }

    /// Row of u · (p2 - p1), the displacement along u. Here p1 and p2 are the joint's points in both bodies, and u is fixed in the first
    /// body.
    fn slide(&self, places: &Places, u: Vector) -> Row {
        let u = places.direction(self.bodies[0], u);
        places.along(self.bodies, &self.seats(places), u, true)
    }

    /// Rows that keep the second body's point on a line of the first body along the axis.
    fn sides(&self, places: &Places, planar: bool) -> Vec<Row> {
        let a = self.axes[0];
        let sides = if planar { vec![cross(EZ, a)] } else { across(a).to_vec() };
        sides.into_iter().map(|u| self.slide(places, u)).collect()
    }

    /// Row of u · w, the cosine of the angle between u of the first body and w of the second.
    fn cosine(&self, places: &Places, u: Vector, w: Vector) -> Row {
        let (u, w) = (places.direction(self.bodies[0], u), places.direction(self.bodies[1], w));
        places.cosine(self.bodies, u, w)
    }

    /// Rows that keep the direction `a` parallel in both bodies.
    fn parallel(&self, places: &Places, a: Vector) -> Vec<Row> {
        across(a).map(|x| self.cosine(places, x, a)).to_vec()
    }

    fn same_turn(&self, places: &Places, planar: bool) -> Vec<Row> {
        if planar {
            let angle = places.angle(self.bodies[1]) - places.angle(self.bodies[0]);
            return vec![places.about(self.bodies, EZ, None).with_value(angle)];
        }
        [(EX, EY), (EY, EZ), (EZ, EX)].map(|(u, w)| self.cosine(places, u, w)).to_vec()
    }

    /// The constraints of the joint.
    pub(crate) fn rows(&self, places: &Places, planar: bool) -> Vec<Row> {
        let [a, b] = self.axes;
        match self.kind {
            Kind::Free | Kind::FreePoint => Vec::new(),
            // the pin stays on the line of the slot and rotates freely
            Kind::PinInSlot => self.sides(places, planar),
            Kind::Revolute if planar => self.coincidence(places, true),
            Kind::Revolute => [self.coincidence(places, false), self.parallel(places, a)].concat(),
            Kind::Spherical => self.coincidence(places, planar),
            Kind::Universal => {
                let mut row = self.cosine(places, a, b);
                row.value -= dot(a, b);
                [self.coincidence(places, false), vec![row]].concat()
            }
            Kind::Weld => {
                [self.coincidence(places, planar), self.same_turn(places, planar)].concat()
            }
            Kind::Prismatic => {
                [self.sides(places, planar), self.same_turn(places, planar)].concat()
            }
            Kind::Cylindrical => [self.sides(places, false), self.parallel(places, a)].concat(),
            Kind::Planar => [vec![self.slide(places, a)], self.parallel(places, a)].concat(),
            Kind::Distance => {
                let length = norm(sub(self.points[1], self.points[0]));
                let mut rows = vec![places.distance(self.bodies, &self.seats(places), length)];
                if self.hinged {
                    let mut row = self.slide(places, a);
                    row.value -= dot(a, sub(self.points[1], self.points[0]));
                    rows.push(row);
                }
                rows
            }
        }
    }

    fn universal(&self, places: &Places, near: [f64; 3]) -> Vec<Row> {
        let [a, b] = self.axes;
        let (a1, b1) = (places.direction(self.bodies[0], a), places.direction(self.bodies[0], b));
        let (a2, b2) = (places.direction(self.bodies[1], a), places.direction(self.bodies[1], b));
        // first angle: about a1, from b1 to b2; second angle: about b2, from a1 to a2; a and b are the axes, 1 and 2 the bodies
        let first = angle_about(a1, b1, b2);
        let second = angle_about(b2, a1, a2);
        let cosine = dot(a, b);
        let share = 1.0 / (1.0 - cosine * cosine);
        // ω = a q̇0 + b q̇1, where the axes a and b need not be perpendicular
        let row = |u: Vector, w: Vector, [i, j]: [usize; 2]| {
            let mut row = places.about(self.bodies, scale(share, u), self.bodies[i]);
            let other = places.about(self.bodies, scale(-share * cosine, w), self.bodies[j]);
            for (part, more) in row.parts.iter_mut().zip(&other.parts) {
                part.1.iter_mut().zip(&more.1).for_each(|(x, y)| *x += y);
            }
            row.bias += other.bias;
            row
        };
        vec![
            row(a1, b2, [0, 1]).with_value(nearest(first, near[0])),
            row(b2, a1, [1, 0]).with_value(nearest(second, near[1])),
        ]
    }

    /// The three rows of the relative angular velocity in global axes. Their values are the components of the rotation vector of the second
    /// body, in axes of the first.
    fn ball(&self, places: &Places, turns: [[f64; 4]; 2], near: [f64; 3]) -> Vec<Row> {
        let relative = nearest_vector(logarithm(compose(conjugate(turns[0]), turns[1])), near);
        let axes = [EX, EY, EZ].into_iter().zip(relative);
        axes.map(|(e, value)| places.about(self.bodies, e, None).with_value(value)).collect()
    }

    /// The joint's coordinates, in the order of the contract of scene files. Of the angles that differ by whole turns, the one nearest to
    /// `near` is used.
    pub(crate) fn coordinates(
        &self,
        places: &Places,
        planar: bool,
        turns: [[f64; 4]; 2],
        near: [f64; 3],
    ) -> Vec<Row> {
        let [a, d] = self.axes;
        let plane_turn = || {
            let angle = places.angle(self.bodies[1]) - places.angle(self.bodies[0]);
            places.about(self.bodies, EZ, None).with_value(nearest(angle, near[0]))
        };
        match self.kind {
            Kind::Weld | Kind::Distance => Vec::new(),
            Kind::Revolute if planar => vec![plane_turn()],
            Kind::Revolute => vec![turn_about(places, self.bodies, a, near[0])],
            Kind::Prismatic => vec![self.slide(places, a)],
            Kind::Cylindrical => {
                vec![self.slide(places, a), turn_about(places, self.bodies, a, near[0])]
            }
            Kind::Universal => self.universal(places, near),
            Kind::Spherical => self.ball(places, turns, near),
            Kind::PinInSlot if planar => vec![self.slide(places, a), plane_turn()],
            Kind::PinInSlot => {
                [vec![self.slide(places, a)], self.ball(places, turns, near)].concat()
            }
            Kind::Planar => vec![
                self.slide(places, d),
                self.slide(places, cross(a, d)),
                turn_about(places, self.bodies, a, near[0]),
            ],
            Kind::Free if planar => {
                vec![self.slide(places, EX), self.slide(places, EY), plane_turn()]
            }
            Kind::FreePoint if planar => vec![self.slide(places, EX), self.slide(places, EY)],
            Kind::FreePoint => [EX, EY, EZ].map(|e| self.slide(places, e)).to_vec(),
            Kind::Free => {
                let slides = [EX, EY, EZ].map(|e| self.slide(places, e)).to_vec();
                [slides, self.ball(places, turns, near)].concat()
            }
        }
    }

    /// Numbers of the coordinates that are angles, in the order of `near`. Translations have smaller numbers.
    pub(crate) fn turning(&self, planar: bool) -> Range<usize> {
        let [slides, turns] = self.kind.coordinates(planar);
        slides..slides + turns
    }

    /// The number of the first component of a rotation vector, for joints that have one.
    pub(crate) fn first_of_ball(&self, planar: bool) -> Option<usize> {
        Some(self.turning(planar)).filter(|turns| turns.len() == 3).map(|turns| turns.start)
    }

    /// Returns the place where the reaction of the joint acts: the joint's point in the second body.
    pub(crate) fn place(&self, places: &Places) -> Vector {
        places.seat(self.bodies[1], self.points[1]).p
    }
}

/// The angle of the second body about an axis of both, as a row. Of the angles that differ by whole turns it is nearest to `near`.
pub(crate) fn turn_about(places: &Places, bodies: [Carrier; 2], a: Vector, near: f64) -> Row {
    let x = across(a)[0];
    let (axis, x1) = (places.direction(bodies[0], a), places.direction(bodies[0], x));
    let x2 = places.direction(bodies[1], x);
    let angle = dot(cross(axis, x1), x2).atan2(dot(x1, x2));
    places.about(bodies, axis, bodies[0]).with_value(nearest(angle, near))
}

/// The angle from `x` to `y` about `axis`.
fn angle_about(axis: Vector, x: Vector, y: Vector) -> f64 {
    let [x, y] = [x, y].map(|v| add(v, scale(-dot(v, axis), axis)));
    dot(axis, cross(x, y)).atan2(dot(x, y))
}

/// Returns the angle plus whole turns, so that it is nearest to `near`.
pub(crate) fn nearest(angle: f64, near: f64) -> f64 {
    let turn = 2.0 * core::f64::consts::PI;
    angle + turn * ((near - angle) / turn).round()
}

/// Returns the rotation vector with whole turns added about its axis, so that it is nearest to `near`.
fn nearest_vector(v: Vector, near: Vector) -> Vector {
    let angle = norm(v);
    if angle < 1e-6 {
        // close to a whole turn the axis is undetermined, so the axis of `near` is used
        let whole = nearest(0.0, norm(near));
        return if whole > 0.0 { add(v, scale(whole, unit(near))) } else { v };
    }
    let axis = scale(1.0 / angle, v);
    scale(nearest(angle, dot(near, axis)), axis)
}
