//! Force of a tire along its plane, and how it shares friction with the side force: the brush model with one parabola of pressure.
//!
//! ```text
//! k_x = (v - w R) / v_e                      v the hub's speed along the plane, w the wheel's rate, v_e as in `tire`
//! x   = C k_x / (mu F),  y = C_y tan a / (mu F),  r = sqrt(x^2 + y^2)
//! s   = 1 - r / 3 + r^2 / 27  for r < 3,  else 1 / r          r s = 1 - (1 - r / 3)^3: the whole patch slides from 3 on
//! Fx  = -C k_x s(r),          Fy = side force alone, times s(r) / s(y)
//! ```
//!
//! C is the stiffness of the force by slip, C_y that of the side force by the slip angle, F the load, mu the friction. Without
//! slip along the plane the side force is as it is alone; a wheel that slides whole has all its friction against the slide,
//! weighted by the two stiffnesses. Source: Pacejka, *Tire and Vehicle Dynamics* (2012), chapter 3, for the brush model; the factor
//! of the side force is the ratio that the same model gives.

use super::entry::entry;
use crate::Real;

/// Force by slip along the plane of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongitudinalSlip<T> {
    /// Force by slip, C [N].
    pub stiffness: T,
    /// Largest force as a share of the load, mu [-].
    pub friction: T,
}

entry!(LongitudinalSlip<T> { stiffness, friction });

/// Force by slip along the plane, with its effect on the side force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipForce<T> {
    /// Force against the slip, -Fx [N].
    pub resistance: T,
    /// Derivative of the resistance by k_x, not negative [N].
    pub slope: T,
    /// Share of the side force that is left [-].
    pub side_share: T,
    /// The slip at which r is 1 without side force [-].
    pub scale: T,
}

/// Returns the factor s(r).
#[doc(hidden)]
pub fn share<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three { T::ONE - r / three + r * r / (three * three * three) } else { T::ONE / r }
}

/// s'(r) / r, for r above zero.
fn fall<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three {
        (T::TWO * r / (three * three * three) - T::ONE / three) / r
    } else {
        -T::ONE / (r * r * r)
    }
}

/// The slope of a force at a rate, with the force `foreseen` there by the iterate before; `scale` is the rate at which r is 1.
///
/// The equation F / s(x) = M x is linearised in both F and x, so that the slope is M s (1 + w s'(x) / s^2), with w the foreseen force over M. By
/// the tangents alone, which vanish where all slides, an iteration goes to and fro; with these it converges from anywhere, and
/// at the solution they are the tangents (Chan, Golub and Mulet 1999).
pub fn slope<T: Real>((force, rate): (T, T), scale: T, foreseen: T) -> Option<T> {
    let x = rate / scale;
    let (size, s) = (x.abs(), share(x.abs()));
    let most = force / (x * s);
    if !(most > T::ZERO && most.is_finite()) {
        return None;
    }
    let w = (foreseen / most).max(-T::ONE).min(T::ONE);
    Some((most / scale * s * (T::ONE + w * x * fall(size) / (s * s))).max(T::ZERO))
}

impl<T: Real> LongitudinalSlip<T> {
    /// The force at a load [N], a slip and a side force that alone would be stiffness times tangent [N]. No load, no force.
    pub fn force(&self, load: T, slip: T, sideways: T) -> SlipForce<T> {
        let most = self.friction * load;
        if !(most > T::ZERO) {
            return SlipForce {
                resistance: T::ZERO,
                slope: T::ZERO,
                side_share: T::ONE,
                scale: T::ONE,
            };
        }
        let (x, y) = (self.stiffness * slip / most, (sideways / most).abs());
        let r = (x * x + y * y).sqrt();
        let s = share(r);
        let bend = if r.is_zero() { T::ZERO } else { x * x * fall(r) };
        SlipForce {
            resistance: self.stiffness * slip * s,
            slope: (self.stiffness * (s + bend)).max(T::ZERO),
            side_share: s / share(y),
            scale: most / self.stiffness,
        }
    }
}
