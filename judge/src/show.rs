//! Values of outputs that are seen from other bodies, of effects, and of the whole scene.

use crate::loads::Loads;
use crate::motion::{Mechanism, State};
use crate::rows::Row;
use crate::scene::{Effect, Exerts, Leaning, Relative, Seen, Whole};
use crate::vector::{Vector, ZERO, add, cross, dot, norm, scale, sub, times, transposed_times};
use crate::wheel::{self, Tread};

impl Mechanism {
    /// The components of a vector that exist in the scene: two in the plane, three in space.
    pub(crate) fn components(&self, v: Vector) -> Vec<f64> {
        v[..if self.scene.planar { 2 } else { 3 }].to_vec()
    }

    /// The components of an angular vector that exist in the scene: one in the plane, three in space.
    pub(crate) fn turning(&self, w: Vector) -> Vec<f64> {
        w[if self.scene.planar { 2 } else { 0 }..].to_vec()
    }

    /// Components of a point's quantity as seen from another body, in the axes of that body.
    pub(crate) fn seen(&self, state: &State, point: &Relative, what: Seen) -> Vec<f64> {
        let places = self.places(state);
        let other = *places.of(point.other);
        let [p, o] =
            [places.seat(Some(point.body), point.at), places.seat(point.other, point.origin)];
        let r = sub(p.p, o.p);
        // velocity as seen from the other body: v = r' - ω × r, where r is the vector between the points
        let v = sub(sub(p.v, o.v), cross(other.w, r));
        let seen = match what {
            Seen::Distance => return vec![norm(r)],
            Seen::Position => r,
            Seen::Velocity => v,
            Seen::Acceleration => {
                let moved = self.evaluate(state).accelerations;
                let of = |body: Option<usize>| body.map_or([0.0; 6], |b| moved[b]);
                let [a, b] = [of(Some(point.body)), of(point.other)];
                let at = |x: [f64; 6], seat: &crate::rows::Seat| {
                    add(add([x[0], x[1], x[2]], cross([x[3], x[4], x[5]], seat.arm)), seat.bias)
                };
                let all = sub(at(a, &p), at(b, &o));
                let carried = add(cross([b[3], b[4], b[5]], r), cross(other.w, cross(other.w, r)));
                sub(all, add(carried, scale(2.0, cross(other.w, v))))
            }
        };
        self.components(transposed_times(&other.turn, seen))
    }

    /// Camber, toe or caster.
    pub(crate) fn leaning(&self, state: &State, leaning: &Leaning) -> f64 {
        let places = self.places(state);
        let drawn = places.direction(Some(leaning.body), leaning.direction);
        let [x, y, z] = leaning.axes.map(|e| dot(places.direction(leaning.vehicle, e), drawn));
        match leaning.angle {
            0 => z.asin(),
            1 => (-x).atan2(y),
            _ => (-x).atan2(z),
        }
    }

    /// A number of an effect, or its force and moment.
    pub(crate) fn exerted(&self, state: &State, number: usize, what: Exerts) -> Vec<f64> {
        let places = self.places(state);
        let now = self.now(state, &places);
        let mut loads = Loads::none(state.frames.len());
        let effect = &self.scene.effects[number];
        let exerted = now.effect(effect, &mut loads);
        let tread = match effect {
            Effect::Tire(tire) => Some(wheel::tread(&now, tire)),
            _ => None,
        };
        let along = exerted.along.as_ref().map(|(row, _)| row);
        let rate = along.map_or(0.0, |row| row.rate(&places));
        let of_tire = |f: fn(&Tread) -> f64| tread.as_ref().map(f).unwrap_or_default();
        let rotor = match effect {
            Effect::Rotor(_, _, inertia) => Some(*inertia),
            _ => None,
        };
        let force = |row: &Row| match rotor {
            // the torque J q'' of the rotor
            Some(inertia) => inertia * self.accelerated(state, row),
            None => -exerted.along.as_ref().map_or(0.0, |(_, force)| *force),
        };
        let number = match what {
            Exerts::Force => match (along, exerted.wrench) {
                (Some(row), _) => force(row),
                (None, wrench) => return self.wrenched(wrench.unwrap_or([ZERO; 2])),
            },
            Exerts::Value => along.map_or(0.0, |row| row.value),
            Exerts::Rate => rate,
            Exerts::Deflection => exerted.deflection,
            Exerts::Energy => rotor.map_or(exerted.stored, |j| 0.5 * j * rate * rate),
            Exerts::Power => match (rotor, along) {
                (Some(_), Some(row)) => -force(row) * rate,
                _ => loads.power_on(&state.frames),
            },
            Exerts::Contact => f64::from(u8::from(exerted.touches)),
            Exerts::Load => of_tire(|tread| tread.load),
            Exerts::SideForce => of_tire(|tread| tread.side),
            Exerts::LongitudinalForce => of_tire(|tread| tread.longitudinal),
            Exerts::SlipAngle => of_tire(|tread| tread.slip_angle),
            Exerts::AligningTorque => of_tire(|tread| tread.aligning),
            Exerts::ContactPoint => {
                return self.components(tread.map_or(ZERO, |tread| tread.point));
            }
        };
        vec![number]
    }

    /// Second derivative of a row.
    pub(crate) fn accelerated(&self, state: &State, row: &Row) -> f64 {
        let moved = self.evaluate(state).accelerations;
        let of = |(body, part): &(Option<usize>, [f64; 6])| {
            body.map_or(0.0, |b| part.iter().zip(&moved[b]).map(|(x, a)| x * a).sum())
        };
        row.parts.iter().map(of).sum::<f64>() + row.bias
    }

    /// A force and a moment as one list of components.
    fn wrenched(&self, [force, moment]: [Vector; 2]) -> Vec<f64> {
        [self.components(force), self.turning(moment)].concat()
    }

    /// A quantity of the whole scene.
    pub(crate) fn whole(&self, state: &State, what: Whole) -> Vec<f64> {
        let places = self.places(state);
        let masses: Vec<f64> = self.scene.bodies.iter().map(|b| b.mass).collect();
        let all: f64 = masses.iter().sum();
        let sum = |of: fn(&crate::rows::Frame) -> Vector| {
            let parts = masses.iter().zip(&state.frames).map(|(m, f)| scale(*m, of(f)));
            parts.fold(ZERO, add)
        };
        let mean = |v: Vector| if all > 0.0 { scale(1.0 / all, v) } else { ZERO };
        match what {
            Whole::Kinetic => vec![self.evaluate(state).energy[0]],
            Whole::Potential => vec![self.evaluate(state).energy[1]],
            Whole::Energy => vec![self.evaluate(state).energy.iter().sum()],
            Whole::CenterOfMass => self.components(mean(sum(|f| f.r))),
            Whole::Momentum => self.components(sum(|f| f.v)),
            Whole::AngularMomentum => {
                let (c, v) = (mean(sum(|f| f.r)), mean(sum(|f| f.v)));
                let of = |(b, f): (usize, &crate::rows::Frame)| {
                    let spin = times(&self.inertia(b, &places), f.w);
                    add(spin, scale(masses[b], cross(sub(f.r, c), sub(f.v, v))))
                };
                self.turning(state.frames.iter().enumerate().map(of).fold(ZERO, add))
            }
            Whole::InvariantError => {
                let begun = self.start().map_or(0.0, |start| self.invariant(&start));
                vec![self.invariant(state) - begun]
            }
        }
    }
}
