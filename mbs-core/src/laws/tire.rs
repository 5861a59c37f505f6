//! A wheel on a road: radial spring and damper, side force and aligning torque, rolling resistance.
//!
//! ```text
//! deflection   x = R - distance of the centre from the road,   F = contact(k x, c x')
//! side         a = atan(v_y / v_e),   v_e = sqrt(v_x^2 + v_s^2),   Fy, Mz = Calspan(F, a, camber), Mz v_x / v_e
//! rolling      Fx = -r F v_x / v_e
//! ```
//!
//! v_x is the centre's speed along the wheel's plane and the road, v_y that of the contact point across the plane. The
//! regularisation v_s = 0.1 m/s makes all forces continuous through standstill, where the side force is a damper; at 5 m/s it
//! changes the slip angle by 2e-4 of itself. The wheel rolls freely: there is no spin and no slip along the wheel.
//! The side force acts at the contact point, rolling resistance at the hub. Source of the radial part: the open Iltis model of
//! UCLouvain, with the distance to the road in place of its vertical distance by the slope (equal on level ground).

use super::body::{Action, BodyMotion};
use super::bumper;
use super::calspan::{self, Coefficients};
use super::foot::foot;
use super::scalar::Measure;
use super::{Part, Supplies};
use crate::Real;
use crate::algebra::{Vector, cross, norm};

/// v_s: speed below which slip is regularised [m/s].
pub const STANDSTILL: f64 = 0.1;

/// A wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tire<T> {
    /// Radius without load [m].
    pub radius: T,
    /// Radial stiffness [N/m] and damping [N s/m].
    pub radial: [T; 2],
    /// Force against rolling as a share of the load [-].
    pub rolling: T,
    /// Side force; `None`: none.
    pub side: Option<Coefficients<T>>,
    /// The road's features.
    pub road: Part,
    /// The course whose vector is (way, speed, -) of a road that comes towards the wheel along -x.
    pub travel: Option<u32>,
    /// The axis that points up: 1 in the plane, 2 in space.
    pub up: usize,
}

/// Places of a tire's actions.
pub const RADIAL: usize = 0;
const ROLLING: usize = 1;
const SIDE: usize = 2;
const ALIGNING: usize = 3;

impl<T: Real> Tire<T> {
    /// Radial force; rolling resistance; side force and aligning torque.
    pub fn n_actions(&self) -> usize {
        if self.side.is_some() {
            4
        } else if self.rolling > T::ZERO {
            2
        } else {
            1
        }
    }

    /// Writes the actions, [`n_actions`](Self::n_actions) of them.
    pub fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        supplies: &Supplies<'_, T>,
        out: &mut [Action<T>],
    ) {
        out.fill(Action::default());
        let [way, speed] = self.travel.map_or([T::ZERO; 2], |course| {
            let [way, speed, _] = supplies.courses[course as usize];
            [way, speed]
        });
        let center = Vector::<T, 3>::from(motion.position);
        let foot = foot(self.road, supplies, [center[0] + way, center[self.up]]);
        let depth = self.radius - foot.distance;
        let normal = self.vector(foot.normal);
        let ground = Vector::<T, 3>::new(-speed, T::ZERO, T::ZERO);
        let velocity = Vector::<T, 3>::from(motion.velocity) - ground;
        let rate = normal.dot(&velocity);
        let contact = bumper::contact(self.radial, depth, -rate);
        let load = contact.force;
        out[RADIAL] = Action {
            force: normal.into(),
            moment: [T::ZERO; 3],
            measure: Measure {
                value: depth,
                rate,
                tension: -load,
                stiffness: contact.stiffness,
                damping: contact.damping,
                drift: normal.dot(&ground),
                ..Measure::default()
            },
        };
        if load > T::ZERO && out.len() > 1 {
            self.roll((load, &normal, foot.distance), (motion, &velocity, &ground), out);
        }
    }

    /// What a loaded wheel does along and across its plane.
    fn roll(
        &self,
        (load, normal, loaded): (T, &Vector<T, 3>, T),
        (motion, velocity, ground): (&BodyMotion<T>, &Vector<T, 3>, &Vector<T, 3>),
        out: &mut [Action<T>],
    ) {
        let axis = Vector::<T, 3>::from(motion.axis);
        let lean = axis.dot(normal);
        let flat = axis - normal * lean;
        let width = norm(&flat);
        // A wheel that lies on its side has no direction: nothing but the radial force acts.
        if !(width > T::from_f64(1e-6)) {
            return;
        }
        let across = flat * (T::ONE / width);
        let along = cross(&across, normal);
        let forward = along.dot(velocity);
        let slow = T::from_f64(STANDSTILL);
        let effective = (forward * forward + slow * slow).sqrt();
        let resistance = self.rolling * load / effective;
        let line = |direction: Vector<T, 3>, arm: Vector<T, 3>, tension: T, damping: T, rate: T| {
            let drift = direction.dot(ground);
            Action {
                force: direction.into(),
                moment: cross(&arm, &direction).into(),
                measure: Measure { rate, tension, damping, drift, ..Measure::default() },
            }
        };
        out[ROLLING] = line(
            along,
            Vector::zeros(),
            resistance * forward,
            resistance * slow * slow / (effective * effective),
            forward,
        );
        let Some(coefficients) = &self.side else { return };
        let arm = *normal * -loaded;
        let spin = Vector::<T, 3>::from(motion.spin);
        let sideways = across.dot(&(velocity + cross(&spin, &arm)));
        let slip = sideways.atan2(effective);
        let side = calspan::side(coefficients, load, slip, lean.atan2(width));
        let by_speed = effective / (effective * effective + sideways * sideways);
        out[SIDE] = line(across, arm, -side.force, side.stiffness * by_speed, sideways);
        let torque = side.torque * forward / effective;
        out[ALIGNING] = Action {
            force: [T::ZERO; 3],
            moment: (*normal).into(),
            measure: Measure { rate: normal.dot(&spin), tension: -torque, ..Measure::default() },
        };
    }

    fn vector(&self, [x, up]: [T; 2]) -> Vector<T, 3> {
        let mut v = Vector::<T, 3>::zeros();
        (v[0], v[self.up]) = (x, up);
        v
    }

    /// Stored energy of an action [J].
    pub fn energy(&self, action: usize, measure: &Measure<T>) -> T {
        if action == RADIAL { bumper::energy(self.radial[0], measure.value) } else { T::ZERO }
    }

    /// Power of an action that is not stored [W].
    pub fn power(&self, action: usize, measure: &Measure<T>) -> T {
        let given = -measure.tension * (measure.rate + measure.drift);
        if action == RADIAL && measure.value > T::ZERO {
            // d(k x^2 / 2)/dt = -k x rate
            return given - self.radial[0] * measure.value * measure.rate;
        }
        given
    }
}
