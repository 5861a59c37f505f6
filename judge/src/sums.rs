//! Sums of coordinates and lengths, as rows.

use crate::joints::turn_about;
use crate::loads::Now;
use crate::parts::reference_length;
use crate::rows::Row;
use crate::scene::{Carrier, Measure, Term};
use crate::vector::{Vector, add, compose, conjugate, cross, dot, norm, scale, unit};

impl Now<'_> {
    /// Returns the row of a measure.
    pub(crate) fn measure(&self, measure: &Measure) -> Row {
        match measure {
            Measure::Coordinate(joint, number) => self.coordinates(*joint).swap_remove(*number),
            Measure::Length(points) => {
                let mut row = self.length(points);
                row.value -= reference_length(points);
                row
            }
            Measure::Wheel(number) => self.wheel(*number),
            Measure::Way(bodies, point, axis) => {
                let seats = bodies.map(|b| self.places.seat(b, *point));
                let along = self.places.direction(bodies[0], *axis);
                self.places.along(*bodies, &seats, along, true)
            }
            Measure::Ball(joint, axis, twists) => self.ball_angle(*joint, *axis, *twists),
        }
    }

    /// The length of a line over points.
    pub(crate) fn length(&self, points: &[(Carrier, Vector)]) -> Row {
        let part = |ends: &[(Carrier, Vector)]| {
            let bodies = [ends[0].0, ends[1].0];
            let seats = [0, 1].map(|i| self.places.seat(ends[i].0, ends[i].1));
            (1.0, self.places.length(bodies, &seats))
        };
        Row::sum(points.windows(2).map(part))
    }

    /// The row of an angle that a coupling measures. Of the angles that differ by whole turns, it has the one nearest to the angle in the
    /// state.
    pub(crate) fn wheel(&self, number: usize) -> Row {
        let wheel = &self.scene.wheels[number];
        if self.scene.planar {
            let [from, to] = wheel.bodies.map(|b| self.places.angle(b));
            let row = self.places.about(wheel.bodies, wheel.axis, None);
            return row.with_value(wheel.axis[2] * (to - from));
        }
        let near = self.turns[self.scene.joints.len() + number][0];
        turn_about(self.places, wheel.bodies, wheel.axis, near)
    }

    /// Row of the angle of a ball joint about an axis, with a bias of zero.
    fn ball_angle(&self, joint: usize, axis: Vector, twists: bool) -> Row {
        let bodies = self.scene.joints[joint].bodies;
        let [a, b] = bodies.map(|body| self.places.direction(body, axis));
        if twists {
            let [q1, q2] = self.quaternions(bodies);
            let q = compose(conjugate(q1), q2);
            let angle = 2.0 * dot([q[1], q[2], q[3]], axis).atan2(q[0]);
            let along = scale(1.0 / (1.0 + dot(a, b)), add(a, b));
            return self.places.about(bodies, along, None).with_value(principal(angle));
        }
        let normal = cross(a, b);
        let sine = norm(normal);
        let along = if sine > 0.0 { unit(normal) } else { [0.0; 3] };
        self.places.about(bodies, along, None).with_value(sine.atan2(dot(a, b)))
    }

    /// A sum of terms.
    pub(crate) fn sum(&self, terms: &[Term]) -> Row {
        Row::sum(terms.iter().map(|term| (term.factor, self.term(term))))
    }

    /// A term without its factor.
    fn term(&self, term: &Term) -> Row {
        let row = self.measure(&term.measure);
        let Some(curve) = &term.curve else { return row };
        // f(m)'' = f' m'' + f'' m'²
        let [value, slope, bend] = curve.at(row.value);
        let rate = row.rate(self.places);
        let mut of_curve = Row::sum([(slope, row)]);
        of_curve.value = value;
        of_curve.bias += bend * rate * rate;
        of_curve
    }
}

/// The angle plus whole turns, between -π and π.
fn principal(angle: f64) -> f64 {
    let turn = 2.0 * core::f64::consts::PI;
    angle - turn * (angle / turn).round()
}

impl Term {
    /// Returns the term that is a factor times a coordinate of a joint.
    pub(crate) fn of(joint: usize, number: usize, factor: f64) -> Self {
        Self { measure: Measure::Coordinate(joint, number), factor, curve: None }
    }
}
