//! Rows: scalar functions of the places of two bodies. A row has a value, a gradient by the velocities of the bodies, and a bias, which is
//! its second derivative without accelerations. Constraints, guides, joint coordinates and the forces along them are made of rows.
//!
//! ```text
//! d²/dt² value = Σ part · (a, α) + bias
//! ```

use crate::scene::{Carrier, Scene};
use crate::vector::{
    Matrix, Quaternion, UNIT, Vector, ZERO, add, cross, dot, norm, rotation, scale, sub, times,
};

/// Place and velocity of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Centre of mass [m].
    pub r: Vector,
    /// Rotation from the reference configuration.
    pub q: Quaternion,
    /// Angle of the body in a planar scene, followed over whole turns [rad].
    pub angle: f64,
    /// Velocity of the centre of mass [m/s].
    pub v: Vector,
    /// Angular velocity, global axes [rad/s].
    pub w: Vector,
}

/// Place and velocities of a body, with its rotation matrix.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placed {
    pub(crate) center: Vector,
    pub(crate) r: Vector,
    pub(crate) turn: Matrix,
    pub(crate) v: Vector,
    pub(crate) w: Vector,
}

/// A point of a body: its place, its velocity, its arm from the centre of mass, and the part of its acceleration that follows from
/// velocities.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seat {
    pub(crate) p: Vector,
    pub(crate) v: Vector,
    pub(crate) arm: Vector,
    pub(crate) bias: Vector,
}

/// Row: a scalar with its derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    /// Gradient by velocity and angular velocity of bodies. Rows of a joint have its two bodies in their order.
    pub(crate) parts: Vec<(Carrier, [f64; 6])>,
    /// Value of the scalar.
    pub(crate) value: f64,
    /// Second derivative of the scalar by time, if all accelerations are zero.
    pub(crate) bias: f64,
    /// Rate and acceleration that the row must have.
    pub(crate) given: [f64; 2],
    /// True if the row constrains rates alone.
    pub(crate) of_rates: bool,
    /// Forces and moments of a unit multiplier on bodies, where they differ from the gradient.
    pub(crate) acts: Option<Vec<(Carrier, [f64; 6])>>,
}

const GROUND: Placed = Placed { center: ZERO, r: ZERO, turn: UNIT, v: ZERO, w: ZERO };

/// Places of all bodies, and of the ground.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    bodies: Vec<Placed>,
    pub(crate) angles: Vec<f64>,
}

impl Places {
    pub(crate) fn new(scene: &Scene, frames: &[Frame]) -> Self {
        let place = |(f, b): (&Frame, &crate::scene::Body)| Placed {
            center: b.center,
            r: f.r,
            turn: rotation(f.q),
            v: f.v,
            w: f.w,
        };
        let bodies = frames.iter().zip(&scene.bodies).map(place).collect();
        Self { bodies, angles: frames.iter().map(|f| f.angle).collect() }
    }

    pub(crate) fn of(&self, body: Carrier) -> &Placed {
        body.map_or(&GROUND, |b| &self.bodies[b])
    }

    pub(crate) fn angle(&self, body: Carrier) -> f64 {
        body.map_or(0.0, |b| self.angles[b])
    }

    /// A point of a body, given in the reference configuration.
    pub(crate) fn seat(&self, body: Carrier, point: Vector) -> Seat {
        let b = self.of(body);
        let arm = times(&b.turn, sub(point, b.center));
        let turning = cross(b.w, arm);
        Seat { p: add(b.r, arm), v: add(b.v, turning), arm, bias: cross(b.w, turning) }
    }

    /// A direction of a body, given in the reference configuration.
    pub(crate) fn direction(&self, body: Carrier, direction: Vector) -> Vector {
        times(&self.of(body).turn, direction)
    }

    /// Row of u · (p2 - p1), where p1 and p2 are points of two bodies, and u is fixed in the first body or in space.
    pub(crate) fn along(
        &self,
        bodies: [Carrier; 2],
        seats: &[Seat; 2],
        u: Vector,
        turns: bool,
    ) -> Row {
        let [s1, s2] = seats;
        let (d, d_rate) = (sub(s2.p, s1.p), sub(s2.v, s1.v));
        let mut about_first = scale(-1.0, cross(s1.arm, u));
        let mut bias = dot(u, sub(s2.bias, s1.bias));
        if turns {
            let w = self.of(bodies[0]).w;
            about_first = add(about_first, cross(u, d));
            let u_rate = cross(w, u);
            bias += 2.0 * dot(u_rate, d_rate) + dot(cross(w, u_rate), d);
        }
        let parts =
            [(bodies[0], six(scale(-1.0, u), about_first)), (bodies[1], six(u, cross(s2.arm, u)))];
        Row::new(parts.to_vec(), dot(u, d), bias)
    }

    /// Row (d·d - L²)/(2 L), which keeps two points at the constant distance L. Here d is the vector between them.
    pub(crate) fn distance(&self, bodies: [Carrier; 2], seats: &[Seat; 2], length: f64) -> Row {
        let (d, rate) = (sub(seats[1].p, seats[0].p), sub(seats[1].v, seats[0].v));
        let mut row = self.along(bodies, seats, scale(1.0 / length, d), false);
        row.value = 0.5 * (dot(d, d) - length * length) / length;
        row.bias += dot(rate, rate) / length;
        row
    }

    /// Row of the length between two points.
    pub(crate) fn length(&self, bodies: [Carrier; 2], seats: &[Seat; 2]) -> Row {
        let d = sub(seats[1].p, seats[0].p);
        let (length, rate) = (norm(d), sub(seats[1].v, seats[0].v));
        let u = scale(1.0 / length, d);
        let mut row = self.along(bodies, seats, u, false);
        row.value = length;
        row.bias += (dot(rate, rate) - dot(u, rate) * dot(u, rate)) / length;
        row
    }

    /// Row of u · w, for global directions u of the first body and w of the second.
    pub(crate) fn cosine(&self, bodies: [Carrier; 2], u: Vector, w: Vector) -> Row {
        let [w1, w2] = bodies.map(|b| self.of(b).w);
        let normal = cross(u, w);
        let change = add(cross(cross(w1, u), w), cross(u, cross(w2, w)));
        let parts = [(bodies[0], six(ZERO, normal)), (bodies[1], six(ZERO, scale(-1.0, normal)))];
        Row::new(parts.to_vec(), dot(u, w), dot(change, sub(w1, w2)))
    }

    /// Row of the angle with the rate a · (ω2 - ω1), where a is fixed in one of the bodies or in space. The caller sets its value.
    pub(crate) fn about(&self, bodies: [Carrier; 2], a: Vector, owner: Carrier) -> Row {
        let [w1, w2] = bodies.map(|b| self.of(b).w);
        let parts = [(bodies[0], six(ZERO, scale(-1.0, a))), (bodies[1], six(ZERO, a))];
        let bias = dot(cross(self.of(owner).w, a), sub(w2, w1));
        Row::new(parts.to_vec(), 0.0, bias)
    }
}

impl Row {
    pub(crate) fn new(parts: Vec<(Carrier, [f64; 6])>, value: f64, bias: f64) -> Self {
        Self { parts, value, bias, given: [0.0; 2], of_rates: false, acts: None }
    }

    /// Sum of rows times factors, in which each body has one part.
    pub(crate) fn sum(rows: impl IntoIterator<Item = (f64, Self)>) -> Self {
        let mut sum = Self::new(Vec::new(), 0.0, 0.0);
        for (factor, row) in rows {
            sum.value += factor * row.value;
            sum.bias += factor * row.bias;
            for (body, part) in row.parts {
                add_part(&mut sum.parts, body, &part.map(|x| factor * x));
            }
        }
        sum
    }

    /// Returns the rate J v of the row.
    pub(crate) fn rate(&self, places: &Places) -> f64 {
        let of = |(body, part): &(Carrier, [f64; 6])| {
            let b = places.of(*body);
            (0..3).map(|i| part[i] * b.v[i] + part[i + 3] * b.w[i]).sum::<f64>()
        };
        self.parts.iter().map(of).sum()
    }

    pub(crate) fn with_value(mut self, value: f64) -> Self {
        self.value = value;
        self
    }
}

/// Adds numbers to the part of a body. If the body has no part, one is made.
pub(crate) fn add_part(parts: &mut Vec<(Carrier, [f64; 6])>, body: Carrier, more: &[f64; 6]) {
    match parts.iter_mut().find(|(b, _)| *b == body) {
        Some((_, part)) => part.iter_mut().zip(more).for_each(|(x, y)| *x += y),
        None => parts.push((body, *more)),
    }
}

pub(crate) fn six(a: Vector, b: Vector) -> [f64; 6] {
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}
