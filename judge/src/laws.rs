//! Laws of forces: gravity, gyroscopic moments of the bodies, and every effect of the contract.

use crate::loads::{Exerted, Loads, Now, contact};
use crate::polynomial;
use crate::rows::Row;
use crate::scene::{Carrier, Effect, Given, Line, Path};
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

    fn path(&self, path: &Path) -> Row {
        match path {
            Path::Ends(line) => self.line(line),
            Path::Points(points) => self.length(points),
            Path::Sum(terms) => self.sum(terms),
        }
    }

    /// Returns all forces on the bodies.
    pub(crate) fn loads(&self) -> Loads {
        let mut loads = Loads::none(self.frames.len());
        for (b, body) in self.scene.bodies.iter().enumerate() {
            let placed = self.places.of(Some(b));
            let weight = scale(body.mass * body.gravity_scale, self.scene.gravity);
            loads.wrench(Some(b), weight, ZERO);
            loads.potential -= dot(weight, placed.r);
        }
        for effect in &self.scene.effects {
            let mut own = Loads::none(self.frames.len());
            let exerted = self.effect(effect, &mut own);
            loads.add(&own);
            loads.potential += exerted.stored;
            loads.power += own.power_on(self.frames) + exerted.stored_rate;
        }
        loads
    }

    /// Adds the forces of an effect.
    #[allow(clippy::too_many_lines, reason = "one arm for each kind")]
    pub(crate) fn effect(&self, effect: &Effect, loads: &mut Loads) -> Exerted {
        let p = self.places;
        match effect {
            Effect::Spring(path, numbers, pulls) => {
                let row = self.path(path);
                self.spring(loads, row, *numbers, *pulls)
            }
            Effect::Polynomial(path, pieces, of_rate) => {
                let row = self.path(path);
                let (value, rate) = (row.value, row.rate(p));
                let x = if *of_rate { rate } else { value };
                let tension = polynomial::value(pieces, x);
                let mut exerted = Exerted::along(loads, row, -tension);
                if !of_rate {
                    exerted.stored = polynomial::integral(pieces, value);
                    exerted.stored_rate = tension * rate;
                }
                exerted
            }
            Effect::Bumper(line, [k, c, clearance]) => {
                let row = self.line(line);
                let x = norm(sub(line.points[1], line.points[0])) - clearance - row.value;
                let rate = -row.rate(p);
                let push = contact(*k, *c, x, rate);
                Exerted::along(loads, row, push).touching(*k, x, rate)
            }
            Effect::Push(path, force) => {
                Exerted::along(loads, self.path(path), self.given(force)[0])
            }
            Effect::Bushing(bodies, at, [k, c]) => self.bushing(loads, *bodies, *at, k, c),
            // a rotor has inertia and exerts no force
            Effect::Rotor(joint, number, _) => {
                Exerted::along(loads, self.coordinates(*joint).swap_remove(*number), 0.0)
            }
            Effect::BodyTorque(body, torque) => {
                let torque = self.given(torque);
                Exerted::on(loads, Some(*body), ZERO, [ZERO, torque])
            }
            Effect::Limit(sum, [lower, upper, k, c]) => {
                let row = self.sum(sum);
                let (value, rate) = (row.value, row.rate(p));
                let [below, above] = [lower - value, value - upper];
                let push = contact(*k, *c, below, -rate) - contact(*k, *c, above, rate);
                let exerted = Exerted::along(loads, row, push);
                if below > above {
                    exerted.touching(*k, below, -rate)
                } else {
                    exerted.touching(*k, above, rate)
                }
            }
            Effect::Friction(sum, [coulomb, sticking, stribeck, viscous, e], factor) => {
                let row = self.sum(sum);
                let r = row.rate(p);
                let ratio = r / stribeck;
                let level = coulomb + (sticking - coulomb) / (1.0 + ratio * ratio);
                let level = level * self.given(factor)[0].max(0.0);
                let force = -(level * r / (r * r + e * e).sqrt() + viscous * r);
                Exerted::along(loads, row, force)
            }
            Effect::Force(body, at, given, turns) => {
                let mut force = self.given(given);
                if *turns {
                    force = p.direction(Some(*body), force);
                }
                let seat = p.seat(Some(*body), *at);
                let mut exerted = Exerted::on(loads, Some(*body), seat.arm, [force, ZERO]);
                if matches!(given, Given::Constant(_)) && !turns {
                    exerted.stored = -dot(force, seat.p);
                    exerted.stored_rate = -dot(force, seat.v);
                }
                exerted
            }
            Effect::Drag(body, at, [area, density]) => {
                let seat = p.seat(Some(*body), *at);
                let force = scale(-0.5 * density * area * norm(seat.v), seat.v);
                Exerted::on(loads, Some(*body), seat.arm, [force, ZERO])
            }
            Effect::SpeedHold(body, direction, [speed, gain, limit]) => {
                let u = p.direction(Some(*body), *direction);
                let placed = p.of(Some(*body));
                let x = gain * (speed - dot(u, placed.v));
                let force = scale(x / (1.0 + (x / limit) * (x / limit)).sqrt(), u);
                Exerted::on(loads, Some(*body), ZERO, [force, ZERO])
            }
            Effect::Tire(tire) => {
                let tread = wheel::tread(self, tire);
                let seat = p.seat(Some(tire.body), tire.center);
                Exerted::on(loads, Some(tire.body), seat.arm, tread.wrench).touching(
                    tire.numbers[1],
                    tread.depth,
                    tread.rate,
                )
            }
        }
    }

    /// A spring with a damper along a row: stiffness, damping, free value. With `pulls` the force is never a push, and the damper fades in
    /// with the elongation.
    fn spring(&self, loads: &mut Loads, row: Row, [k, c, free]: [f64; 3], pulls: bool) -> Exerted {
        let (x, rate) = (row.value - free, row.rate(self.places));
        if pulls {
            let tension = contact(k, c, x, rate);
            let exerted = Exerted::along(loads, row, -tension).touching(k, x, rate);
            return Exerted { deflection: x, ..exerted };
        }
        let (stored, stored_rate) = (0.5 * k * x * x, k * x * rate);
        let exerted = Exerted::along(loads, row, -(k * x + c * rate));
        Exerted { deflection: x, stored, stored_rate, ..exerted }
    }

    /// Springs and dampers along axes of the first body, and about these axes by the rotation vector.
    fn bushing(
        &self,
        loads: &mut Loads,
        bodies: [Carrier; 2],
        at: Vector,
        k: &[f64; 6],
        c: &[f64; 6],
    ) -> Exerted {
        let p = self.places;
        let seats = bodies.map(|b| p.seat(b, at));
        let (mut on_second, mut stored, mut stored_rate) = (ZERO, 0.0, 0.0);
        for i in 0..3 {
            let mut e = ZERO;
            e[i] = 1.0;
            let e = p.direction(bodies[0], e);
            let row = p.along(bodies, &seats, e, true);
            let rate = row.rate(p);
            let force = -(k[i] * row.value + c[i] * rate);
            loads.along(&row, force);
            on_second = add(on_second, scale(force, e));
            stored += 0.5 * k[i] * row.value * row.value;
            stored_rate += k[i] * row.value * rate;
        }
        let turn = p.of(bodies[0]).turn;
        let relative = sub(p.of(bodies[1]).w, p.of(bodies[0]).w);
        let (phi, inverse) = if self.scene.planar {
            let angle = p.angle(bodies[1]) - p.angle(bodies[0]);
            ([0.0, 0.0, angle], crate::vector::UNIT)
        } else {
            let [q1, q2] = self.quaternions(bodies);
            // the quaternions have followed their bodies continuously, so that rotations beyond half a turn are right too
            let phi = followed(compose(conjugate(q1), q2));
            (phi, inverse_tangent(phi))
        };
        let rate = times(&inverse, transposed_times(&turn, relative));
        let load = [0, 1, 2].map(|i| k[i + 3] * phi[i] + c[i + 3] * rate[i]);
        let torque = times(&turn, scale(-1.0, times(&transpose(&inverse), load)));
        for i in 0..3 {
            stored += 0.5 * k[i + 3] * phi[i] * phi[i];
            stored_rate += k[i + 3] * phi[i] * rate[i];
        }
        loads.wrench(bodies[1], ZERO, torque);
        loads.wrench(bodies[0], ZERO, scale(-1.0, torque));
        let wrench = Some([on_second, torque]);
        Exerted { wrench, stored, stored_rate, ..Exerted::default() }
    }

    /// Angles of all joints, followed over whole turns: nearest to their values in the state.
    pub(crate) fn measured_turns(&self) -> Vec<[f64; 3]> {
        let of = |j: usize| {
            let mut turns = self.turns[j];
            let turning = self.scene.joints[j].turning(self.scene.planar);
            if !turning.is_empty() {
                let rows = self.coordinates(j);
                // the coordinates are followed already
                rows[turning].iter().zip(&mut turns).for_each(|(row, t)| *t = row.value);
            }
            turns
        };
        let joints = (0..self.scene.joints.len()).map(of);
        let wheels = (0..self.scene.wheels.len()).map(|i| [self.wheel(i).value, 0.0, 0.0]);
        joints.chain(wheels).collect()
    }
}

/// The matrix J⁻¹ of φ̇ = J⁻¹ ω, J⁻¹ = 1 - ½ [φ] + (1 - (θ/2) cot(θ/2))/θ² [φ]². Here φ is the rotation vector, θ its length, and ω the
/// angular velocity of the second body against the first, in axes of the first.
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
