//! The directions of a wheel's carrier as seen from the vehicle body, by the terms of ISO 8855.
//!
//! ```text
//! x forward, y inward, z up: axes that turn with the vehicle body
//! R_xy = x.a,  R_yy = y.a,  R_zy = z.a      a: the wheel's axis, towards the vehicle's middle
//! R_xz = x.s,  R_yz = y.s,  R_zz = z.s      s: the steering axis, upwards
//! ```
//!
//! Inward is forward x up on the left side and up x forward on the right side, so one set of formulas covers both sides. The wheel's axis
//! and the steering axis are directions of the carrier. By default they are y and z of the reference configuration; R is then the rotation
//! of the carrier relative to the vehicle body.

use super::super::frame::{Frame, normalised};
use super::kind::Maker;
use crate::Real;
use crate::algebra::{Vector, cross};
use crate::model::State;
use crate::scene::{VehicleSide, WheelCarrier};

/// Carrier and vehicle body, with directions of both in the reference configuration.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct CarrierDirection<T: Real, const D: usize> {
    carrier: Frame<T, D>,
    vehicle: Frame<T, D>,
    /// Directions forward, inward and up of the vehicle body.
    axes: [Vector<T, 3>; 3],
    /// Wheel's axis or steering axis, a direction of the carrier.
    direction: Vector<T, 3>,
}

impl<T: Real, const D: usize> CarrierDirection<T, D> {
    /// Prepares a direction of the carrier. By default it is axis number `i` of the vehicle body. The sign of the direction is such that
    /// its component along this axis is positive.
    pub(super) fn new(of: &WheelCarrier<T>, from: &Maker<'_, T, D>, i: usize) -> Self {
        let [up, forward] = [of.up, of.forward].map(|x| normalised(&Vector::from(x)));
        // component of `forward` that is perpendicular to `up`
        let forward = normalised(&(forward - up * up.dot(&forward)));
        let inward = match of.side {
            VehicleSide::Left => cross(&forward, &up),
            VehicleSide::Right => cross(&up, &forward),
        };
        let axes = [forward, inward, up];
        let given = of.axis.map_or(axes[i], |axis| normalised(&Vector::from(axis)));
        let direction = if given.dot(&axes[i]) < T::ZERO { -given } else { given };
        let [carrier, vehicle] = [of.body, of.relative_to].map(|body| Frame::new(from.model, body));
        Self { carrier, vehicle, axes, direction }
    }

    /// Components of the carrier's direction along the axes forward, inward and up.
    pub(super) fn parts(&self, state: &State<T>) -> [T; 3] {
        let now = self.carrier.rotation(&state.q) * self.direction;
        let seen = self.vehicle.rotation(&state.q).transpose() * now;
        self.axes.each_ref().map(|axis| axis.dot(&seen))
    }
}
