//! Longitudinal slip force of a tire, and its effect on the side force: the brush model with parabolic pressure.
//!
//! ```text
//! k_x = (v - w R) / v_e                      v the hub's speed along the plane, w the wheel's rate, v_e as in `tire`
//! x   = C k_x / (mu F),  y = C_y tan a / (mu F),  r = sqrt(x^2 + y^2)
//! s   = 1 - r / 3 + r^2 / 27  for r < 3,  else 1 / r          r s = 1 - (1 - r / 3)^3: the whole contact patch slides for r >= 3
//! Fx  = -C k_x s(r),          Fy = side force alone, times s(r) / s(y)
//! ```
//!
//! C is the longitudinal slip stiffness, C_y the cornering stiffness, F the load, mu the friction, a the slip angle. Without
//! longitudinal slip the side force is unchanged. If the whole patch slides, friction acts against the sliding direction, weighted
//! by the two stiffnesses. Source: Pacejka, *Tire and Vehicle Dynamics* (2012), chapter 3, for the brush model. The factor of the
//! side force is the ratio that this model gives.

use super::entry::entry;
use crate::Real;

/// Longitudinal slip force of a wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongitudinalSlip<T> {
    /// Longitudinal slip stiffness C [N].
    pub stiffness: T,
    /// Friction mu: largest force relative to the load [-].
    pub friction: T,
}

entry!(LongitudinalSlip<T> { stiffness, friction });

/// Longitudinal slip force, with its effect on the side force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipForce<T> {
    /// Force against the slip, -Fx [N].
    pub resistance: T,
    /// Derivative of the resistance by k_x, not negative [N].
    pub slope: T,
    /// Remaining fraction of the side force [-].
    pub side_share: T,
    /// Slip at which r = 1 without side force [-].
    pub scale: T,
}

/// Returns the sliding factor s(r).
#[doc(hidden)]
pub fn share<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three { T::ONE - r / three + r * r / (three * three * three) } else { T::ONE / r }
}

/// Ratio s'(r) / r of the derivative of the sliding factor and r, for r > 0.
fn fall<T: Real>(r: T) -> T {
    let three = T::TWO + T::ONE;
    if r < three {
        (T::TWO * r / (three * three * three) - T::ONE / three) / r
    } else {
        -T::ONE / (r * r * r)
    }
}

/// Slope of a force at a rate. The iterate before predicts the force `foreseen` for this rate; `scale` is the rate at which r = 1.
///
/// The equation F / s(x) = M x, with x = rate / scale, is linearised in both F and x. The slope is M s (1 + w s'(x) / s^2), with w
/// the foreseen force over M. The tangents alone vanish where the whole patch slides, and the iteration would oscillate. With this
/// slope it converges from any start, and at the solution the slope equals the tangent (Chan, Golub and Mulet 1999).
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
    /// Slip force at a load [N] and a slip; `sideways` is the side force without saturation, C_y tan a [N]. Without load the force
    /// is zero.
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
