//! Forces of the road on the tire of a wheel.

use crate::curves::height;
use crate::loads::Now;
use crate::scene::{Calspan, Feature, Tire};
use crate::vector::{Vector, ZERO, add, cross, dot, scale, sub, unit};

/// Speed below which slip is regularised [m/s]: given by the law of the contract.
const STANDING: f64 = 0.1;

/// Least cosine of the camber [-]: given by the law of the contract.
const LEAST_COSINE: f64 = 0.1;

/// The x of the road's point nearest to the place (x, y).
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

/// Forces of the road on a tire, with its depth and its lowest point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tread {
    /// Depth of the contact; negative while the tire is above the road.
    pub(crate) depth: f64,
    /// Rate of the depth.
    pub(crate) rate: f64,
    /// Load: force along the road's normal; the tire only pushes.
    pub(crate) load: f64,
    /// Side force of the tire.
    pub(crate) side: f64,
    /// Force along the wheel's plane and the road.
    pub(crate) longitudinal: f64,
    /// Slip angle, of tires with a side force.
    pub(crate) slip_angle: f64,
    /// Moment about the normal.
    pub(crate) aligning: f64,
    /// Lowest point of the tire.
    pub(crate) point: Vector,
    /// Force, and moment about the centre of the wheel.
    pub(crate) wrench: [Vector; 2],
}

/// The road at its point nearest to the centre of a wheel: normal, tangent, distance of the centre, and rotation of the normal per
/// displacement of the centre.
struct Ground {
    n: Vector,
    t: Vector,
    d: f64,
    turning: f64,
}

/// The road under the centre of a wheel.
fn ground(now: &Now<'_>, tire: &Tire, center: Vector) -> Ground {
    let up = if now.scene.planar { 1 } else { 2 };
    let features = &now.scene.road[usize::from(!now.scene.planar && tire.center[1] < 0.0)];
    let x = center[0] + now.scene.road_speed * now.t;
    let at = foot(features, x, center[up]);
    let [h, slope, bend] = height(features, at);
    let mut n = ZERO;
    (n[0], n[up]) = (-slope, 1.0);
    let n = unit(n);
    let mut t = ZERO;
    (t[0], t[up]) = (n[up], -n[0]);
    let d = (x - at) * n[0] + (center[up] - h) * n[up];
    // n normal, t tangent, κ curvature, s road length, d distance of the centre: dn/ds = -κ t, and s grows by 1/(1 - κ d) per displacement
    let curvature = bend / (1.0 + slope * slope).powf(1.5);
    Ground { n, t, d, turning: -curvature / (1.0 - curvature * d) }
}

/// Returns the forces of the road on a tire.
pub(crate) fn tread(now: &Now<'_>, tire: &Tire) -> Tread {
    let body = Some(tire.body);
    let seat = now.places.seat(body, tire.center);
    let [radius, k, c, _] = tire.numbers;
    let Ground { n, t, d, turning } = ground(now, tire, seat.p);
    let mut velocity = seat.v;
    velocity[0] += now.scene.road_speed;
    let axis = tire.axis.map(|a| now.places.direction(body, a));
    let sine = axis.map_or(0.0, |a| dot(a, n));
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    // beyond 84 degrees the cosine of the camber is constant, and its rate is zero
    let counts = cosine > LEAST_COSINE;
    let held = cosine.max(LEAST_COSINE);
    let n_rate = scale(turning * dot(t, velocity), t);
    let w = now.places.of(body).w;
    let axis_rate = axis.map_or(ZERO, |a| cross(w, a));
    let sine_rate = dot(axis_rate, n) + axis.map_or(0.0, |a| dot(a, n_rate));
    let depth = radius - d / held;
    let leaning = if counts { d * sine / held.powi(3) } else { 0.0 };
    let rate = -dot(n, velocity) / held - leaning * sine_rate;
    let radial = crate::loads::contact(k, c, depth, rate);
    let load = radial / held;
    // arm from the centre to the contact point
    let down = axis.map_or(scale(-1.0, n), |a| unit(sub(scale(sine, a), n)));
    let arm = scale(d / held, down);
    // the contact depth also depends on the normal, which rotates as the centre moves: this force belongs to that rotation
    let along = axis.map_or(0.0, |a| dot(a, t));
    let bent = radial * leaning * along * turning;
    let force = add(scale(load, n), scale(bent, t));
    let moment = if counts { cross(arm, scale(load, n)) } else { ZERO };
    let mut tread = Tread {
        depth,
        rate,
        load,
        side: 0.0,
        longitudinal: 0.0,
        slip_angle: 0.0,
        aligning: 0.0,
        point: add(seat.p, arm),
        wrench: [force, moment],
    };
    if radial > 0.0 {
        // in the plane the wheel's axis is z
        let of_plane = now.scene.planar.then_some([0.0, 0.0, 1.0]);
        if let Some(axis) = axis.or(of_plane) {
            let sliding = Sliding { axis, n, down, arm, velocity, w, sine };
            sliding.load(tire, &mut tread);
        }
    }
    tread
}

/// Motion of a tire over the road: axis, normal, direction down in the wheel's plane, arm from the centre to the contact point, velocity of
/// the centre against the road, angular velocity, and sine of the camber.
struct Sliding {
    axis: Vector,
    n: Vector,
    down: Vector,
    arm: Vector,
    velocity: Vector,
    w: Vector,
    sine: f64,
}

impl Sliding {
    /// Adds the side force and the force along the wheel's plane.
    fn load(&self, tire: &Tire, tread: &mut Tread) {
        let [radius, _, _, resistance] = tire.numbers;
        // forward is parallel to the wheel's plane and to the road
        let forward = unit(cross(self.axis, self.n));
        let left = cross(self.n, forward);
        let vx = dot(forward, self.velocity);
        let ve = (vx * vx + STANDING * STANDING).sqrt();
        let below = |arm: Vector| add(self.velocity, cross(self.w, arm));
        let vy = dot(left, below(self.arm));
        let drag = -resistance * tread.load * vx / ve;
        let rim = scale(radius, self.down);
        let (by_slip, share) = tire.slip.map_or((0.0, 1.0), |[stiffness, friction]| {
            let most = friction * tread.load;
            let x = stiffness * dot(forward, below(rim)) / ve / most;
            let cornering = tire.side.as_ref().map_or(0.0, |side| side.cornering(tread.load));
            let y = cornering * vy / ve / most;
            let r = (x * x + y * y).sqrt();
            (-most * x * slides(r), slides(r) / slides(y.abs()))
        });
        tread.longitudinal = drag + by_slip;
        if let Some(side) = &tire.side {
            tread.slip_angle = (vy / ve).atan();
            let (force, moment) = side.at(tread.load, tread.slip_angle, self.sine.asin());
            tread.side = share * force;
            tread.aligning = share * moment * vx / ve;
        }
        let [force, moment] = &mut tread.wrench;
        let across = scale(tread.side, left);
        *force = add(*force, add(scale(tread.longitudinal, forward), across));
        *moment = add(*moment, cross(self.arm, across));
        *moment = add(*moment, cross(rim, scale(by_slip, forward)));
        *moment = add(*moment, scale(tread.aligning, self.n));
    }
}

/// Ratio s(r) of the slip force to the force without sliding, where r is the force without sliding relative to the friction limit.
/// While a part of the contact patch slides, s = 1 - r/3 + r²/27. Where the whole patch slides, s = 1/r.
fn slides(r: f64) -> f64 {
    if r < 3.0 { 1.0 - r / 3.0 + r * r / 27.0 } else { 1.0 / r }
}

impl Calspan {
    /// Cornering stiffness at a load: side force per slip angle, for small angles.
    fn cornering(&self, load: f64) -> f64 {
        let [a0, a1, a2, ..] = self.a;
        if load <= self.omega * a2 { a0 - a1 * load * (load - a2) / a2 } else { a0 }
    }

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
