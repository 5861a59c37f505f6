//! A wheel on its road.

use crate::curves::height;
use crate::loads::{Loads, Now};
use crate::rows::six;
use crate::scene::{Calspan, Feature, Tire};
use crate::vector::{Vector, add, cross, dot, scale, sub, unit};

/// Speed below which slip is regularised [m/s]: the law's own number.
const STANDING: f64 = 0.1;

/// Least cosine of the camber [-]: the law's own number.
const LEAST_COSINE: f64 = 0.1;

/// The point of a road nearest to a place: its x.
fn foot(features: &[Feature], x: f64, y: f64) -> f64 {
    let mut at = x;
    for _ in 0..100 {
        let [h, h1, h2] = height(features, at);
        let residual = at - x + (h - y) * h1;
        let slope = (1.0 + h1 * h1 + (h - y) * h2).max(0.1);
        at -= residual / slope;
        if (residual / slope).abs() < 1e-15 * (1.0 + at.abs()) {
            break;
        }
    }
    at
}

/// Adds the forces of a tire.
pub(crate) fn load(now: &Now<'_>, tire: &Tire, loads: &mut Loads) {
    let up = if now.scene.planar { 1 } else { 2 };
    let body = Some(tire.body);
    let seat = now.places.seat(body, tire.center);
    let [radius, k, c, resistance] = tire.numbers;
    let features = &now.scene.road[usize::from(!now.scene.planar && tire.center[1] < 0.0)];
    let way = now.scene.road_speed * now.t;
    let x = seat.p[0] + way;
    let at = foot(features, x, seat.p[up]);
    let [h, slope, bend] = height(features, at);
    let mut n = [0.0; 3];
    (n[0], n[up]) = (-slope, 1.0);
    let n = unit(n);
    let mut t = [0.0; 3];
    (t[0], t[up]) = (n[up], -n[0]);
    let d = (x - at) * n[0] + (seat.p[up] - h) * n[up];
    let mut velocity = seat.v;
    velocity[0] += now.scene.road_speed;
    let axis = tire.axis.map(|a| now.places.direction(body, a));
    let sine = axis.map_or(0.0, |a| dot(a, n));
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    // beyond 84 degrees the camber is held: then it does not change either
    let counts = cosine > LEAST_COSINE;
    let held = cosine.max(LEAST_COSINE);
    // the normal turns with the way of the centre: dn/ds = -κ t, by the foot's own way over 1 - κ d
    let curvature = bend / (1.0 + slope * slope).powf(1.5);
    let turning = -curvature / (1.0 - curvature * d);
    let n_rate = scale(turning * dot(t, velocity), t);
    let w = now.places.of(body).w;
    let axis_rate = axis.map_or([0.0; 3], |a| cross(w, a));
    let sine_rate = dot(axis_rate, n) + axis.map_or(0.0, |a| dot(a, n_rate));
    let d_rate = dot(n, velocity);
    let depth = radius - d / held;
    let leaning = if counts { d * sine / held.powi(3) } else { 0.0 };
    let radial = crate::loads::contact(k, c, depth, -d_rate / held - leaning * sine_rate);
    if radial <= 0.0 {
        return;
    }
    let size = radial / held;
    // from the centre to the contact point
    let down = axis.map_or(scale(-1.0, n), |a| unit(sub(scale(sine, a), n)));
    let arm = add(seat.arm, scale(d / held, down));
    let hub = if counts { arm } else { seat.arm };
    loads.wrench(body, scale(size, n), cross(hub, scale(size, n)));
    // what turns the normal as the centre moves
    let along = axis.map_or(0.0, |a| dot(a, t));
    let bent = radial * leaning * along * turning;
    loads.wrench(body, scale(bent, t), cross(seat.arm, scale(bent, t)));
    let Some(axis) = axis else { return };
    // forward: along the wheel's plane and the road
    let forward = unit(cross(axis, n));
    let left = cross(n, forward);
    let vx = dot(forward, velocity);
    let ve = (vx * vx + STANDING * STANDING).sqrt();
    let drag = scale(-resistance * size * vx / ve, forward);
    loads.wrench(body, drag, cross(seat.arm, drag));
    let Some(side) = &tire.side else { return };
    let mut contact_velocity = add(seat.v, cross(w, sub(arm, seat.arm)));
    contact_velocity[0] += now.scene.road_speed;
    let slip = (dot(left, contact_velocity) / ve).atan();
    let (force, moment) = side.at(size, slip, sine.asin());
    let force: Vector = scale(force, left);
    let pair = six(force, add(cross(arm, force), scale(moment * vx / ve, n)));
    loads.wrench(body, [pair[0], pair[1], pair[2]], [pair[3], pair[4], pair[5]]);
}

impl Calspan {
    /// Side force and aligning torque at a load, a slip angle and a camber.
    fn at(&self, load: f64, slip: f64, camber: f64) -> (f64, f64) {
        let ([a0, a1, a2, a3, a4], [b1, b3, b4]) = (self.a, self.b);
        let friction = ((b1 * load + b3 + b4 * load * load) * self.skid).max(0.2);
        let b = if load <= self.omega * a2 {
            let d = a1 * load * (load - a2) - a0 * a2;
            let of_camber = -a2 * a3 * (a4 - load) * load / (a4 * d) * camber;
            d / (a2 * friction * load) * (slip + of_camber)
        } else {
            let of_camber = a2 * a3 * self.omega * (a4 - self.omega * a2) / (a0 * a4) * camber;
            -a0 / (friction * load) * (slip + of_camber)
        };
        let share =
            if b.abs() < 3.0 { b - b * b.abs() / 3.0 + b * b * b / 27.0 } else { b.signum() };
        let force = friction * load * share;
        (force, (self.trail[0] * load + self.trail[1] * force.abs()) * force)
    }
}
