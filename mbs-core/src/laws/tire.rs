//! Tire of a wheel on a road: a thin disc pressed into the road, with side force, aligning torque and rolling resistance.
//!
//! ```text
//! camber       sin g = u.n           u the axis, n the road's normal at the point nearest to the centre, d its distance
//! deflection   x = R - d / cos g,    F = contact(k x, c x')
//! contact      r = -(d / cos g) e,   e = (n - (u.n) u) / cos g       from the centre to the lowest point of the disc
//! row of x     -dx = (n / cos g + d (u.n) (u.t) s / cos^3 g t).dc + (r x n / cos g).dtheta,   dn = s (t.dc) t
//! load         F / cos g, along n
//! side         a = atan(v_y / v_e),  v_e = sqrt(v_x^2 + v_s^2),   Fy, Mz = Calspan(load, a, g), Mz v_x / v_e
//! rolling      Fx = -r load v_x / v_e
//! driven       slip (v_x - w R) / v_e, at R below the centre: see [`slip`](super::slip)
//! ```
//!
//! The radial force is the generalised force whose work is done on the deflection x. Its main part is a force n F / cos g at the
//! contact point. On a bend of the road with tangent t, the normal rotates at the rate s per length of the centre's path. This adds
//! a second part. So k x^2 / 2 is the potential of the force in every position of the wheel. The road is replaced by its tangent
//! plane at the point nearest to the centre. On a bend this point differs from the disc's nearest point by a term of the order of
//! the squared camber. A wheel without an axis has no camber: cos g = 1. In the plane no wheel has camber.
//!
//! v_x is the speed of the centre along the wheel's plane and the road. v_y is the speed across the plane of the contact point,
//! taken as a point of the carrier. If the carrier rolls about x, the tire slides sideways on the ground, and the side force does
//! this work. The regularisation v_s = 0.1 m/s keeps all forces continuous at standstill, where the side force is a damper. At 5
//! m/s it changes the slip angle by 2e-4 of its value. Without longitudinal slip the wheel rolls freely. The angular momentum of
//! the wheel's spin belongs to a separate body on the carrier, if the scene has one. The side force acts at the contact point, the
//! rolling resistance at the hub. With longitudinal slip the law acts on the spinning body, and the slip force has the arm R. So a
//! wheel without slip turns at v_x / R, and the slip force dissipates only the work of the slip.
//!
//! Range: camber has an effect up to 84 degrees, beyond which cos g stays 0.1. A wheel with its centre below the road is pushed out
//! along n. Both rules keep the deflection continuous. Source: the open Iltis model of UCLouvain has the same contact point. That
//! model omits the camber in the deflection, so that its radial force has no potential, and takes v_y at the centre. Either choice
//! changes the lateral displacement at the end of ramp steers at 10, 20 and 30 m/s by at most 0.04 %.

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

/// Law of a tire on a road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TireLaw<T> {
    /// Radius of the unloaded tire [m].
    pub radius: T,
    /// Radial stiffness [N/m] and damping [N s/m].
    pub radial: [T; 2],
    /// Rolling resistance relative to the load [-].
    pub rolling: T,
    /// Coefficients of the side force; `None`: no side force.
    pub side: Option<Coefficients<T>>,
    /// Longitudinal slip force of a wheel that spins; `None`: the wheel rolls freely.
    pub longitudinal: Option<LongitudinalSlip<T>>,
    /// Features of the road.
    pub road: Part,
    /// Signal with the vector (distance, speed, unused) of a road that moves towards the wheel along -x; `None`: the road is fixed.
    pub travel: Option<u32>,
    /// Number of the axis that points up: 1 in the plane, 2 in space.
    pub up: usize,
    /// True if the wheel is a disc that leans with its axis. Otherwise it has no camber.
    pub leans: bool,
}

/// State of a tire over its road.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TireContact<T> {
    /// Deflection, positive when pressed in [m], and the rate at which it decreases [m/s].
    pub deflection: [T; 2],
    /// Position of the centre, along the road from its origin and up [m].
    pub place: [T; 2],
    /// Velocity of the centre relative to the road, along the road and up [m/s].
    pub speed: [T; 2],
}

/// Contact of the wheel with the road, and its motion over the road.
struct Stand<T> {
    stance: Stance<T>,
    /// Position of the centre, along the road and up [m].
    place: [T; 2],
    /// Velocity of the centre relative to the road, and velocity of the road [m/s].
    velocity: Vector<T, 3>,
    ground: Vector<T, 3>,
    /// Deflection [m], and the rate at which it decreases [m/s].
    depth: T,
    rate: T,
}

/// Geometry of the contact of a wheel with its road.
struct Stance<T> {
    /// Normal of the road, a unit vector.
    normal: Vector<T, 3>,
    /// Distance from the centre to the contact point, d / cos g [m].
    reach: T,
    /// Factor 1 / cos g of the distance [-].
    stretch: T,
    /// Row of minus the deflection: its derivative by a displacement and by a rotation about the centre.
    row: [Vector<T, 3>; 2],
}

/// Least cosine of the camber [-]: beyond 84° the factor 1 / cos g would grow without bound. Chosen, not tuned.
const LEAST_COSINE: f64 = 0.1;

/// Least sine of the angle between axis and normal [-], below which the wheel has no direction of travel. Chosen, not tuned.
const LEAST_WIDTH: f64 = 1e-6;

/// Place of the radial force among the tire's unit wrenches.
pub const RADIAL: usize = 0;
/// Place of the rolling resistance among the tire's unit wrenches.
const ROLLING: usize = 1;
/// Place of the side force among the tire's unit wrenches.
const SIDE: usize = 2;
/// Place of the aligning torque among the tire's unit wrenches.
const ALIGNING: usize = 3;
/// Place of the longitudinal slip force among the tire's unit wrenches.
#[doc(hidden)]
pub const SLIP: usize = 4;

/// Sets the slopes of sliding forces with the iterate before. The slip force gets `slip::slope`. Rolling resistance and side force
/// get at least the slope of the secant, if the iteration crossed rest. The tangents vanish where sliding is fast, and iterations
/// with them would oscillate.
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

/// Force at the end of an arm, given by tension, damping and rate relative to the road. The road has the velocity `ground`.
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
    /// Deflection of the tire, and its place over the road. Cost: the search for the nearest point, without forces.
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

    /// Returns the contact of a wheel with the given axis, and the row of its deflection.
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
        // d(d / cos g) by the rotation of the axis relative to the normal
        let share = reach * lean * stretch * stretch;
        let tangent = self.vector([foot.normal[1], -foot.normal[0]]);
        let bending = tangent * (share * foot.turn() * axis.dot(&tangent));
        Stance { reach, stretch, row: [force + bending, cross(axis, &normal) * share], ..upright }
    }

    /// Writes the actions of a loaded wheel along and across its plane, with the forces of rolling and slip.
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
        // A wheel flat on its side has no direction of travel: only the radial force acts.
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
        // -e: downward direction in the wheel's plane
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
            // the rate at which r = 1, which the slope of the next iteration needs
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

    /// Component of a vector in the upward direction.
    fn along_up(&self, v: &Vector<T, 3>) -> T {
        if self.up == 1 { v[1] } else { v[2] }
    }
}

impl<T: Real> WrenchesLaw<T> for TireLaw<T> {
    /// Number of actions: radial force, rolling resistance, side force, aligning torque, slip force.
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

    /// Writes the actions to `out`; their number is [`n_actions`](Self::n_actions).
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
            // the unit wrench, the slip force, the cornering stiffness, and the side force reduced by slip
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

    /// Power of an action that is not stored as energy [W].
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
        // arm to the contact point: r = -(d / cos g) e,   e = (n - (u.n) u) / cos g
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

    /// Largest distance along the road from the centre to the contact point: on a slope it is less than the radius.
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

/// Operations of the search for the nearest point: one height on a level road, otherwise the largest number of the search.
fn nearest<T: Real>(features: &[Feature<T>]) -> Operations {
    let ops = Operations::new;
    let (mut height, mut hollow) = (Operations::NONE, Operations::NONE);
    for feature in features {
        let (value, bend) = match feature {
            Feature::Flat(_) => (Operations::NONE, Operations::NONE),
            // The rounded corner at the end has the highest cost.
            Feature::Rise { .. } => (ops(4, 5).and(4, 0, 0), ops(1, 3).and(1, 0, 0)),
            Feature::Bump { .. } => (ops(8, 2).and(1, 0, 1), ops(3, 2).and(1, 0, 0)),
            // The slopes at both ends of a table show whether the road rises there.
            Feature::Spline(_) => (ops(21, 14).and(4, 0, 0), ops(42, 30).and(9, 0, 0)),
        };
        height += value + ops(0, 3);
        hollow += bend;
    }
    if features.iter().all(|feature| matches!(feature, Feature::Flat(_))) {
        return height + ops(0, 3);
    }
    // D and D' at a point, the step to the next point, and the test of acceptance.
    let spot = height + ops(9, 12).and(1, 0, 0);
    let (settled, cell) = (ops(5, 8).and(1, 0, 0), ops(0, 2));
    let cells = u64::from(CELLS);
    spot * count(most_heights::<T>())
        + settled * (1 + cells)
        + cell * cells
        + hollow
        + ops(12, 13).and(5, 4, 0)
}
