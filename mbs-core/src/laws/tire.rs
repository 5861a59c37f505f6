//! A wheel on a road: a thin disc pressed into it, side force and aligning torque, rolling resistance.
//!
//! ```text
//! camber       sin g = u.n           u the axis, n the road's normal at the point nearest to the centre, d its distance
//! deflection   x = R - d / cos g,    F = contact(k x, c x')
//! contact      r = -(d / cos g) e,   e = (n - (u.n) u) / cos g       the disc's lowest point, from the centre
//! its row      -dx = (n / cos g + d (u.n) (u.t) s / cos^3 g t).dc + (r x n / cos g).dtheta,   dn = s (t.dc) t
//! load         F / cos g, along n
//! side         a = atan(v_y / v_e),  v_e = sqrt(v_x^2 + v_s^2),   Fy, Mz = Calspan(load, a, g), Mz v_x / v_e
//! rolling      Fx = -r load v_x / v_e
//! driven       slip (v_x - w R) / v_e, at R below the centre: see [`slip`](super::slip)
//! ```
//!
//! The radial force is the one that does work on x: a force n F / cos g at the contact point and, where the road bends along its
//! tangent t, what turns the normal as the centre moves. So k x^2 / 2 is its potential in every position of the wheel. The road
//! is taken as its tangent plane at the point nearest to the centre, which on a bend differs from the disc's own nearest point
//! by the square of the camber. A wheel without an axis, and every wheel in the plane, has no camber: cos g = 1.
//!
//! v_x is the centre's speed along the wheel's plane and the road, v_y that of the contact point, fixed in the carrier, across
//! the plane. Where the carrier rolls, its tire slides sideways on the ground, and the side force does that work.
//! The regularisation v_s = 0.1 m/s makes all forces continuous through standstill, where the side force is a damper; at 5 m/s
//! it changes the slip angle by 2e-4 of itself. Without slip along its plane the wheel rolls freely. The angular momentum of
//! its spin is that of a body of its own on the carrier, where a scene has one. The side force acts at the contact point,
//! rolling resistance at the hub. With slip the law acts on the body that spins; its force has the arm R, so that a wheel without
//! slip turns by v_x / R, and what it takes is the slip's alone.
//!
//! Range: camber counts up to 84 degrees, where cos g is held at 0.1; a wheel whose centre is below the road is pushed out along
//! n. Both keep the deflection continuous. Source: the open Iltis model of UCLouvain has the same contact point. It leaves the
//! camber out of the deflection, so that its radial force has no potential, and takes v_y at the centre. With either, its ramp
//! steers at 10, 20 and 30 m/s end within 0.04 % of the way across.

use super::body::{BodyMotion, MAX_ACTIONS, TireForces, UnitWrench, WrenchesLaw, put};

use super::bumper;
use super::calspan::{self, Coefficients};
use super::corner::{self, LawCorner};
use super::entry::entry;
use super::operations::{Operations, count};
use super::road::Feature;
use super::road_contact::{CELLS, RoadContact, most_heights, road_contact};
use super::scalar::ScalarForce;
use super::slip::{self, LongitudinalSlip};
use super::{LawInputs, Part};
use crate::Real;
use crate::algebra::{Vector, cross, norm};

/// Speed v_s below which slip is regularised [m/s]. Chosen, not tuned.
pub const STANDSTILL: f64 = 0.1;

/// Law of a wheel on a road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TireLaw<T> {
    /// Radius without load [m].
    pub radius: T,
    /// Radial stiffness [N/m] and damping [N s/m].
    pub radial: [T; 2],
    /// Force against rolling as a share of the load [-].
    pub rolling: T,
    /// Coefficients of the side force; `None`: no side force.
    pub side: Option<Coefficients<T>>,
    /// Force by slip along its plane, of a wheel that spins; `None`: it rolls freely.
    pub longitudinal: Option<LongitudinalSlip<T>>,
    /// Features of the road.
    pub road: Part,
    /// The course whose vector is (way, speed, -) of a road that comes towards the wheel along -x.
    pub travel: Option<u32>,
    /// The axis that points up: 1 in the plane, 2 in space.
    pub up: usize,
    /// Is it a disc that leans with its axis? Else it has no camber.
    pub leans: bool,
}

/// A wheel over its road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TireContact<T> {
    /// Deflection, positive pressed in [m], and the rate at which it ends [m/s].
    pub deflection: [T; 2],
    /// The centre, along the road from its zero and up [m].
    pub place: [T; 2],
    /// Velocity of the centre against the road, along it and up [m/s].
    pub speed: [T; 2],
}

/// Stance of the wheel on the road, and its motion over it.
struct Stand<T> {
    stance: Stance<T>,
    /// The centre, along the road and up.
    place: [T; 2],
    /// Velocity of the centre against the road, and the road's own.
    velocity: Vector<T, 3>,
    ground: Vector<T, 3>,
    /// The deflection and the rate at which it ends.
    depth: T,
    rate: T,
}

/// Contact of a wheel with its road.
struct Stance<T> {
    /// Normal of the road, a unit vector.
    normal: Vector<T, 3>,
    /// From the centre to the contact point, d / cos g [m].
    reach: T,
    /// 1 / cos g.
    stretch: T,
    /// The row of the deflection, force and moment about the centre, with the sign of growing distance.
    row: [Vector<T, 3>; 2],
}

/// Least cosine of the camber [-]: beyond 84° the stretch 1 / cos g would grow without bound. Chosen, not tuned.
const LEAST_COSINE: f64 = 0.1;

/// Least sine of the angle between axis and normal [-], below which the wheel has no direction. Chosen, not tuned.
const LEAST_WIDTH: f64 = 1e-6;

/// Place of the radial force among a tire's unit wrenches.
pub const RADIAL: usize = 0;
/// Place of the rolling resistance.
const ROLLING: usize = 1;
/// Place of the side force.
const SIDE: usize = 2;
/// Place of the aligning torque.
const ALIGNING: usize = 3;
/// Place of the force by slip.
#[doc(hidden)]
pub const SLIP: usize = 4;

/// Sliding has at least the slope of the secant where an iteration went across rest. The tangents alone vanish where sliding is fast: the
/// iteration would oscillate.
#[inline]
fn look_back<T: Real>(action: usize, measure: &mut ScalarForce<T>, before: &ScalarForce<T>) {
    if action == SLIP {
        let foreseen = before.tension + before.damping * (measure.rate - before.rate);
        let found = slip::slope((measure.tension, measure.rate), measure.value, foreseen);
        measure.damping = found.unwrap_or(measure.damping);
        return;
    }
    if (action == ROLLING || action == SIDE) && measure.rate * before.rate < T::ZERO {
        let secant = (measure.tension - before.tension) / (measure.rate - before.rate);
        measure.damping = measure.damping.max(secant);
    }
}

/// A force at the end of an arm: its tension, damping and rate against the road, whose own velocity is `ground`.
#[inline]
fn line<T: Real>(
    (direction, arm): (Vector<T, 3>, Vector<T, 3>),
    [tension, damping, rate]: [T; 3],
    ground: &Vector<T, 3>,
) -> UnitWrench<T> {
    let drift = direction.dot(ground);
    UnitWrench {
        force: direction.into(),
        moment: cross(&arm, &direction).into(),
        measure: ScalarForce { rate, tension, damping, drift, ..ScalarForce::default() },
    }
}

entry!(TireLaw<T> { radius, radial, rolling, side, longitudinal, road, travel, up, leans });

impl<T: Real> TireLaw<T> {
    /// Deflection of the wheel, and where it is over its road. Cost: that of the nearest point, and no force.
    pub fn contact(&self, motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> TireContact<T> {
        let Stand { place, velocity, depth, rate, .. } = self.stand(motion, law_inputs);
        TireContact {
            deflection: [depth, rate],
            place,
            speed: [velocity[0], self.along_up(&velocity)],
        }
    }

    #[inline]
    fn stand(&self, motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> Stand<T> {
        let [way, speed] = self.travel.map_or([T::ZERO; 2], |course| {
            let [way, speed, _] = law_inputs.course(course);
            [way, speed]
        });
        let center = Vector::<T, 3>::from(motion.position);
        let place = [center[0] + way, self.along_up(&center)];
        let foot = road_contact(self.road, law_inputs, place);
        let stance = self.stance(&Vector::from(motion.axis), &foot);
        let depth = self.radius - stance.reach;
        let ground = Vector::<T, 3>::new(-speed, T::ZERO, T::ZERO);
        let velocity = Vector::<T, 3>::from(motion.velocity) - ground;
        let [force, moment] = &stance.row;
        let mut rate = force.dot(&velocity);
        if self.leans {
            rate += moment.dot(&Vector::from(motion.spin));
        }
        Stand { stance, place, velocity, ground, depth, rate }
    }

    /// Returns the contact of a wheel with the given axis, and how its deflection changes.
    fn stance(&self, axis: &Vector<T, 3>, foot: &RoadContact<T>) -> Stance<T> {
        let normal = self.vector(foot.normal);
        let upright = Stance {
            normal,
            reach: foot.distance,
            stretch: T::ONE,
            row: [normal, Vector::zeros()],
        };
        if !self.leans {
            return upright;
        }
        let lean = axis.dot(&normal);
        let cosine = norm(&(axis - normal * lean));
        let least = T::from_f64(LEAST_COSINE);
        let stretch = T::ONE / cosine.max(least);
        let (reach, force) = (foot.distance * stretch, normal * stretch);
        if !(cosine > least) {
            return Stance { reach, stretch, row: [force, Vector::zeros()], ..upright };
        }
        // d(d / cos g) by what turns the axis against the normal.
        let share = reach * lean * stretch * stretch;
        let tangent = self.vector([foot.normal[1], -foot.normal[0]]);
        let bending = tangent * (share * foot.turn() * axis.dot(&tangent));
        Stance { reach, stretch, row: [force + bending, cross(axis, &normal) * share], ..upright }
    }

    /// Writes the actions of a loaded wheel along and across its plane.
    fn roll(
        &self,
        (load, stance): (T, &Stance<T>),
        (motion, velocity, ground): (&BodyMotion<T>, &Vector<T, 3>, &Vector<T, 3>),
        out: &mut [UnitWrench<T>],
    ) {
        let (axis, normal) = (Vector::<T, 3>::from(motion.axis), &stance.normal);
        let lean = axis.dot(normal);
        let flat = axis - normal * lean;
        let width = norm(&flat);
        // A wheel that lies on its side has no direction: nothing but the radial force acts.
        if !(width > T::from_f64(LEAST_WIDTH)) {
            return;
        }
        let across = flat * (T::ONE / width);
        let along = cross(&across, normal);
        let forward = along.dot(velocity);
        let slow = T::from_f64(STANDSTILL);
        let effective = (forward * forward + slow * slow).sqrt();
        let resistance = self.rolling * load / effective;
        let slope = resistance * slow * slow / (effective * effective);
        let rolling =
            line((along, Vector::zeros()), [resistance * forward, slope, forward], ground);
        put(out, ROLLING, rolling);
        // -e: down in the wheel's plane.
        let down = (axis * lean - normal) * (T::ONE / width);
        let arm = down * stance.reach;
        let spin = Vector::<T, 3>::from(motion.spin);
        let sideways = across.dot(&(velocity + cross(&spin, &arm)));
        let (angle, camber) = (sideways.atan2(effective), lean.atan2(width));
        let mut side = self.side.as_ref().map(|c| calspan::side(c, load, angle, camber));
        if let Some(law) = &self.longitudinal {
            let cornering =
                self.side.as_ref().map_or(T::ZERO, |c| calspan::cornering_stiffness(c, load));
            let arm = down * self.radius;
            let slipping = along.dot(&(velocity + cross(&spin, &arm)));
            let force = law.force(load, slipping / effective, cornering * sideways / effective);
            if let Some(side) = &mut side {
                side.force *= force.side_share;
                side.torque *= force.side_share;
                side.stiffness *= force.side_share;
            }
            let slope = force.slope / effective;
            let mut slip = line((along, arm), [force.resistance, slope, slipping], ground);
            // where the iterations look back for the slope
            slip.measure.value = force.scale * effective;
            put(out, SLIP, slip);
        }
        let Some(side) = side else { return };
        let by_speed = effective / (effective * effective + sideways * sideways);
        let sideways_force = [-side.force, side.stiffness * by_speed, sideways];
        let sideways_force = line((across, arm), sideways_force, ground);
        put(out, SIDE, sideways_force);
        let torque = side.torque * forward / effective;
        let aligning = UnitWrench {
            force: [T::ZERO; 3],
            moment: (*normal).into(),
            measure: ScalarForce {
                rate: normal.dot(&spin),
                tension: -torque,
                ..ScalarForce::default()
            },
        };
        put(out, ALIGNING, aligning);
    }

    fn vector(&self, [x, up]: [T; 2]) -> Vector<T, 3> {
        if self.up == 1 {
            Vector::<T, 3>::new(x, up, T::ZERO)
        } else {
            Vector::<T, 3>::new(x, T::ZERO, up)
        }
    }

    /// Component of a vector that points up.
    fn along_up(&self, v: &Vector<T, 3>) -> T {
        if self.up == 1 { v[1] } else { v[2] }
    }
}

impl<T: Real> WrenchesLaw<T> for TireLaw<T> {
    /// Number of actions: radial force; rolling resistance; side force and aligning torque; force by slip.
    fn n_actions(&self) -> usize {
        if self.longitudinal.is_some() {
            5
        } else if self.side.is_some() {
            4
        } else if self.rolling > T::ZERO {
            2
        } else {
            1
        }
    }

    /// Writes the actions, [`n_actions`](Self::n_actions) of them.
    fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        law_inputs: &LawInputs<'_, T>,
        out: &mut [UnitWrench<T>],
    ) {
        out.fill(UnitWrench::default());
        let Stand { stance, velocity, ground, depth, rate, .. } = self.stand(motion, law_inputs);
        let [force, moment] = &stance.row;
        let contact = bumper::contact(self.radial, depth, -rate);
        let radial = UnitWrench {
            force: (*force).into(),
            moment: (*moment).into(),
            measure: ScalarForce {
                value: depth,
                rate,
                tension: -contact.force,
                stiffness: contact.stiffness,
                damping: contact.damping,
                drift: force.dot(&ground),
                ..ScalarForce::default()
            },
        };
        put(out, RADIAL, radial);
        let load = contact.force * stance.stretch;
        if load > T::ZERO && out.len() > 1 {
            self.roll((load, &stance), (motion, &velocity, &ground), out);
        }
    }

    fn operations(&self, law_inputs: &LawInputs<'_, T>) -> Operations {
        let stance = Operations::new(43, 25).and(2, 1, 0);
        let radial = bumper::OPERATIONS + Operations::new(4, 2);
        let rolling = Operations::new(71, 37).and(6, 3, 2);
        let side = Operations::new(33, 11).and(5, 0, 0);
        let mut all =
            stance + radial + rolling + side + nearest(self.road.of(law_inputs.features()));
        if self.longitudinal.is_some() {
            // the unit wrench, the force by slip, the cornering stiffness and what is left of the side force
            all += Operations::new(30, 18)
                + Operations::new(28, 11).and(9, 1, 0)
                + Operations::new(24, 9).and(4, 0, 0)
                + Operations::new(4, 0).and(1, 0, 0);
        }
        all
    }

    fn needs_rotation(&self) -> bool {
        self.leans || self.n_actions() > 1
    }

    #[inline]
    fn look_back(&self, action: usize, measure: &mut ScalarForce<T>, before: &ScalarForce<T>) {
        if before.rate != T::ZERO {
            look_back(action, measure, before);
        }
    }

    #[inline]
    fn secant(&self, action: usize, measure: &ScalarForce<T>) -> T {
        if action == SLIP { measure.secant() } else { measure.damping }
    }

    /// Stored energy of an action [J].
    fn energy(&self, action: usize, measure: &ScalarForce<T>) -> T {
        if action == RADIAL { bumper::energy(self.radial[0], measure.value) } else { T::ZERO }
    }

    /// Power of an action that is not stored [W].
    fn power(&self, action: usize, measure: &ScalarForce<T>) -> T {
        let given = -measure.tension * (measure.rate + measure.drift);
        if action == RADIAL && measure.value > T::ZERO {
            // d(k x^2 / 2)/dt = -k x rate
            return given - self.radial[0] * measure.value * measure.rate;
        }
        given
    }

    fn n_gaps(&self) -> usize {
        1
    }

    fn has_fade(&self) -> bool {
        self.radial[1] > T::ZERO
    }

    fn watch(&self, motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> [[T; 2]; 3] {
        let TireContact { deflection, place, speed } = self.contact(motion, law_inputs);
        let [depth, rate] = deflection;
        [[-depth, rate], [place[0], speed[0]], [place[1], speed[1]]]
    }

    fn tire(&self, motion: &BodyMotion<T>, law_inputs: &LawInputs<'_, T>) -> Option<TireForces<T>> {
        let mut out = [UnitWrench::default(); MAX_ACTIONS];
        self.evaluate(motion, law_inputs, &mut out);
        let Stand { stance, .. } = self.stand(motion, law_inputs);
        let [radial, rolling, side, aligning, slip] = out.map(|action| action.measure);
        let (center, axis) = (Vector::<T, 3>::from(motion.position), Vector::from(motion.axis));
        // r = -(d / cos g) e,   e = (n - (u.n) u) / cos g
        let lean = if self.leans { axis.dot(&stance.normal) } else { T::ZERO };
        let flat = stance.normal - axis * lean;
        let slow = T::from_f64(STANDSTILL);
        let effective = (rolling.rate * rolling.rate + slow * slow).sqrt();
        let unit = flat * (T::ONE / norm(&flat).max(T::from_f64(LEAST_WIDTH)));
        Some(TireForces {
            load: -radial.tension * stance.stretch,
            side: -side.tension,
            longitudinal: -(rolling.tension + slip.tension),
            aligning: -aligning.tension,
            slip_angle: side.rate.atan2(effective),
            contact: (center - unit * stance.reach).into(),
        })
    }

    fn may_have_kinks(&self) -> bool {
        true
    }

    fn kinks(&self, law_inputs: &LawInputs<'_, T>, take: &mut dyn FnMut(LawCorner<T>)) {
        corner::of_road(self.road, law_inputs, take);
    }

    /// On a slope a wheel stands off its foot by less than its radius.
    fn reach(&self) -> T {
        self.radius
    }

    fn fits(&self, law_inputs: &LawInputs<'_, T>, n_courses: usize) -> bool {
        let (features, knots) = (law_inputs.features(), law_inputs.knots());
        let are_splines = self.road.of(features).iter().all(|feature| match feature {
            Feature::Spline(part) => part.is_within(knots.0.len()) && part.is_within(knots.1.len()),
            _ => true,
        });
        self.road.is_within(features.len())
            && are_splines
            && self.travel.is_none_or(|course| (course as usize) < n_courses)
            && self.up < 3
    }
}

/// The nearest point of a road: one height where it is level, elsewhere as many as the search may ask for.
fn nearest<T: Real>(features: &[Feature<T>]) -> Operations {
    let ops = Operations::new;
    let (mut height, mut hollow) = (Operations::NONE, Operations::NONE);
    for feature in features {
        let (value, bend) = match feature {
            Feature::Flat(_) => (Operations::NONE, Operations::NONE),
            // In the rounded corner at the end.
            Feature::Rise { .. } => (ops(4, 5).and(4, 0, 0), ops(1, 3).and(1, 0, 0)),
            Feature::Bump { .. } => (ops(8, 2).and(1, 0, 1), ops(3, 2).and(1, 0, 0)),
            // The slopes at both ends of a table show whether it rises from them.
            Feature::Spline(_) => (ops(21, 14).and(4, 0, 0), ops(42, 30).and(9, 0, 0)),
        };
        height += value + ops(0, 3);
        hollow += bend;
    }
    if features.iter().all(|feature| matches!(feature, Feature::Flat(_))) {
        return height + ops(0, 3);
    }
    // D and D' at a place, the step to the next, and whether it is taken.
    let spot = height + ops(9, 12).and(1, 0, 0);
    let (settled, cell) = (ops(5, 8).and(1, 0, 0), ops(0, 2));
    let cells = u64::from(CELLS);
    spot * count(most_heights::<T>())
        + settled * (1 + cells)
        + cell * cells
        + hollow
        + ops(12, 13).and(5, 4, 0)
}
