//! Laws of forces: gravity, the bodies' own turning, and every effect of the contract.

use crate::loads::{Loads, Now, contact};
use crate::rows::Row;
use crate::scene::{Carrier, Effect, Line};
use crate::vector::{
    Vector, ZERO, add, compose, conjugate, cross, dot, followed, norm, scale, sub, times,
    transpose, transposed_times,
};
use crate::wheel;

impl Now<'_> {
    pub(crate) fn quaternions(&self, bodies: [Carrier; 2]) -> [[f64; 4]; 2] {
        bodies.map(|b| b.map_or([1.0, 0.0, 0.0, 0.0], |b| self.frames[b].q))
    }

    /// The coordinates of a joint.
    pub(crate) fn coordinates(&self, joint: usize) -> Vec<Row> {
        let data = &self.scene.joints[joint];
        let turns = self.quaternions(data.bodies);
        data.coordinates(self.places, self.scene.planar, turns, self.turns[joint])
    }

    /// The coordinate that effects of a joint act on.
    pub(crate) fn turn(&self, joint: usize) -> Row {
        let number = self.scene.joints[joint].rotation(self.scene.planar).unwrap_or(0);
        self.coordinates(joint).swap_remove(number)
    }

    fn line(&self, line: &Line) -> Row {
        let seats = [0, 1].map(|i| self.places.seat(line.bodies[i], line.points[i]));
        match line.direction {
            None => self.places.length(line.bodies, &seats),
            Some(u) => {
                let u = self.places.direction(line.bodies[0], u);
                self.places.along(line.bodies, &seats, u, true)
            }
        }
    }

    /// Returns all forces on the bodies.
    pub(crate) fn loads(&self) -> Loads {
        let mut loads = Loads { on: vec![[0.0; 6]; self.frames.len()], potential: 0.0, power: 0.0 };
        for (b, body) in self.scene.bodies.iter().enumerate() {
            let placed = self.places.of(Some(b));
            let weight = scale(body.mass * body.gravity_scale, self.scene.gravity);
            loads.wrench(Some(b), weight, ZERO);
            loads.potential -= dot(weight, placed.r);
        }
        for effect in &self.scene.effects {
            let before = loads.on.clone();
            let (stored, rate) = self.effect(effect, &mut loads);
            loads.potential += stored;
            let all: f64 = loads
                .on
                .iter()
                .zip(&before)
                .zip(self.frames)
                .map(|((f, g), frame)| {
                    (0..3)
                        .map(|i| (f[i] - g[i]) * frame.v[i] + (f[i + 3] - g[i + 3]) * frame.w[i])
                        .sum::<f64>()
                })
                .sum();
            loads.power += all + rate;
        }
        loads
    }

    /// Adds the forces of an effect; returns what it stores and the rate of that.
    #[allow(clippy::too_many_lines, reason = "one arm for each kind")]
    fn effect(&self, effect: &Effect, loads: &mut Loads) -> (f64, f64) {
        let p = self.places;
        match effect {
            Effect::SpringDamper(line, [k, c, free]) => {
                let row = self.line(line);
                let (x, rate) = (row.value - free, row.rate(p));
                loads.along(&row, -(k * x + c * rate));
                return (0.5 * k * x * x, k * x * rate);
            }
            Effect::Polynomial(line, pieces, of_rate) => {
                let row = self.line(line);
                let x = if *of_rate { row.rate(p) } else { row.value };
                loads.along(&row, -polynomial(pieces, x));
            }
            Effect::Bumper(line, [k, c, clearance]) => {
                let row = self.line(line);
                let x = norm(sub(line.points[1], line.points[0])) - clearance - row.value;
                loads.along(&row, contact(*k, *c, x, -row.rate(p)));
            }
            Effect::Actuator(line, force) => {
                let row = self.line(line);
                loads.along(&row, self.given(force)[0]);
            }
            Effect::Bushing(bodies, at, [k, c]) => self.bushing(loads, *bodies, *at, k, c),
            Effect::TorsionSpring(sum, [k, c, free]) => {
                let row = self.sum(sum);
                let (x, rate) = (row.value - free, row.rate(p));
                loads.along(&row, -(k * x + c * rate));
                return (0.5 * k * x * x, k * x * rate);
            }
            Effect::JointTorque(sum, torque) => {
                loads.along(&self.sum(sum), self.given(torque)[0]);
            }
            // an inertia, no force
            Effect::Rotor(..) => {}
            Effect::BodyTorque(body, torque) => {
                loads.wrench(Some(*body), ZERO, self.given(torque));
            }
            Effect::Limit(sum, [lower, upper, k, c]) => {
                let row = self.sum(sum);
                let rate = row.rate(p);
                let push = contact(*k, *c, lower - row.value, -rate)
                    - contact(*k, *c, row.value - upper, rate);
                loads.along(&row, push);
            }
            Effect::Friction(sum, [coulomb, sticking, stribeck, viscous, e]) => {
                let row = self.sum(sum);
                let r = row.rate(p);
                let ratio = r / stribeck;
                let level = coulomb + (sticking - coulomb) / (1.0 + ratio * ratio);
                loads.along(&row, -(level * r / (r * r + e * e).sqrt() + viscous * r));
            }
            Effect::Force(body, at, force, turns) => {
                let mut force = self.given(force);
                if *turns {
                    force = p.direction(Some(*body), force);
                }
                loads.at_point(Some(*body), p.seat(Some(*body), *at).arm, force);
            }
            Effect::Drag(body, at, [area, density]) => {
                let seat = p.seat(Some(*body), *at);
                let force = scale(-0.5 * density * area * norm(seat.v), seat.v);
                loads.at_point(Some(*body), seat.arm, force);
            }
            Effect::SpeedHold(body, direction, [speed, gain, limit]) => {
                let u = p.direction(Some(*body), *direction);
                let x = gain * (speed - dot(u, p.of(Some(*body)).v));
                let force = scale(x / (1.0 + (x / limit) * (x / limit)).sqrt(), u);
                loads.at_point(Some(*body), ZERO, force);
            }
            Effect::Tire(tire) => wheel::load(self, tire, loads),
        }
        (0.0, 0.0)
    }

    /// Springs and dampers along axes of the first body, and about them by the rotation vector.
    fn bushing(
        &self,
        loads: &mut Loads,
        bodies: [Carrier; 2],
        at: Vector,
        k: &[f64; 6],
        c: &[f64; 6],
    ) {
        let p = self.places;
        let seats = bodies.map(|b| p.seat(b, at));
        for i in 0..3 {
            let mut e = ZERO;
            e[i] = 1.0;
            let row = p.along(bodies, &seats, p.direction(bodies[0], e), true);
            let force = -(k[i] * row.value + c[i] * row.rate(p));
            loads.along(&row, force);
        }
        let turn = p.of(bodies[0]).turn;
        let relative = sub(p.of(bodies[1]).w, p.of(bodies[0]).w);
        let torque = if self.scene.planar {
            let angle = p.angle(bodies[1]) - p.angle(bodies[0]);
            [0.0, 0.0, -(k[5] * angle + c[5] * relative[2])]
        } else {
            let [q1, q2] = self.quaternions(bodies);
            // the quaternions have followed their bodies, beyond half a turn too
            let phi = followed(compose(conjugate(q1), q2));
            let inverse = inverse_tangent(phi);
            let rate = times(&inverse, transposed_times(&turn, relative));
            let load = [0, 1, 2].map(|i| k[i + 3] * phi[i] + c[i + 3] * rate[i]);
            times(&turn, scale(-1.0, times(&transpose(&inverse), load)))
        };
        loads.wrench(bodies[1], ZERO, torque);
        loads.wrench(bodies[0], ZERO, scale(-1.0, torque));
    }

    /// Turns of all joints, nearest to those of before.
    pub(crate) fn measured_turns(&self) -> Vec<[f64; 3]> {
        let of = |j: usize| {
            let mut turns = self.turns[j];
            let turning = self.scene.joints[j].turning(self.scene.planar);
            if !turning.is_empty() {
                let rows = self.coordinates(j);
                // the coordinates are nearest to those of before already
                rows[turning].iter().zip(&mut turns).for_each(|(row, t)| *t = row.value);
            }
            turns
        };
        let joints = (0..self.scene.joints.len()).map(of);
        let wheels = (0..self.scene.wheels.len()).map(|i| [self.wheel(i).value, 0.0, 0.0]);
        joints.chain(wheels).collect()
    }
}

/// φ̇ = J⁻¹ ω, J⁻¹ = 1 - ½ [φ] + (1 - (θ/2) cot(θ/2))/θ² [φ]²; ω in axes of the first body, of the second against it.
fn inverse_tangent(phi: Vector) -> [[f64; 3]; 3] {
    let angle = norm(phi);
    let factor = if angle < 1e-2 {
        let a = angle * angle;
        1.0 / 12.0 + a / 720.0 + a * a / 30240.0
    } else {
        (1.0 - 0.5 * angle / (0.5 * angle).tan()) / (angle * angle)
    };
    let column = |e: Vector| {
        let once = cross(phi, e);
        add(add(e, scale(-0.5, once)), scale(factor, cross(phi, once)))
    };
    transpose(&[column([1.0, 0.0, 0.0]), column([0.0, 1.0, 0.0]), column([0.0, 0.0, 1.0])])
}

/// The piece that holds, or its tangent where none does.
fn polynomial(pieces: &[Vec<f64>], x: f64) -> f64 {
    let value = |piece: &[f64], x: f64| {
        let (mut sum, mut slope) = (0.0, 0.0);
        for c in piece[2..].iter().rev() {
            slope = slope * x + sum;
            sum = sum * x + c;
        }
        [sum, slope]
    };
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else { return 0.0 };
    let tangent = |piece: &[f64], at: f64| {
        let [sum, slope] = value(piece, at);
        sum + slope * (x - at)
    };
    if x < first[0] {
        return tangent(first, first[0]);
    }
    pieces.iter().find(|p| x < p[1]).map_or_else(|| tangent(last, last[1]), |p| value(p, x)[0])
}
