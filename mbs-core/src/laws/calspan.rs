//! Side force and aligning torque of a tire: the Calspan model.
//!
//! ```text
//! mu = (B1 F + B3 + B4 F^2) k
//! F <= W A2:  D = A1 F (F - A2) - A0 A2,  a_g = -A2 A3 (A4 - F) F / (A4 D) g,  b = D / (A2 mu F) (a + a_g)
//! F >  W A2:  a_g = A2 A3 W (A4 - W A2) / (A0 A4) g,                           b = -A0 / (mu F) (a + a_g)
//! s = b - b|b|/3 + b^3/27 for |b| < 3, else sign(b)
//! Fy = mu F s,   Mz = (AF1 F + AF2 |Fy|) Fy
//! ```
//!
//! F is the normal load, a the slip angle, g the camber. Source: Frik, Leister and Schwartz, *Simulation of the IAVSD Road Vehicle
//! Benchmark Bombardier Iltis* (1993), in the form of the open Iltis model of UCLouvain. Above F = W A2 the cornering stiffness
//! falls to A0, for the Iltis a sixteenth of its peak. This is a property of the published formula. Mz changes its sign where
//! |Fy| > F. The friction mu falls with the load, and would be negative above 26.5 kN for the Iltis. From 22.2 kN on, outside the range
//! of the model, it is 0.2.

use super::entry::entry;
use crate::Real;

/// Least friction coefficient [-]: the polynomial is negative at loads outside its fitted range. Chosen, not tuned.
pub const LEAST_FRICTION: f64 = 0.2;

/// Coefficients of the Calspan model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients<T> {
    /// Coefficients A0 [N/rad], A1 [1/rad], A2 [N], A3 [1/rad], A4 [N] of the cornering stiffness.
    pub a: [T; 5],
    /// Ratio W: the stiffness follows the parabola up to the load W A2 [-].
    pub omega: T,
    /// Coefficients B1 [1/N], B3 [-], B4 [1/N^2] of the friction.
    pub b: [T; 3],
    /// Skid ratio k, a factor of the friction [-].
    pub skid: T,
    /// Coefficients AF1, AF2 of the aligning torque [m/N].
    pub trail: [T; 2],
}

entry!(Coefficients<T> { a, omega, b, skid, trail });

impl<T> Coefficients<T> {
    /// Coefficients of the tire of the Bombardier Iltis, converted from doubles by `n`.
    pub(crate) fn iltis_by(n: impl Fn(f64) -> T) -> Self {
        Self {
            a: [n(2625.0), n(14.47), n(12930.0), n(2.29), n(18175.0)],
            omega: n(1.0),
            b: [n(-0.464e-4), n(1.216), n(2.18e-11)],
            skid: n(1.0274),
            trail: [n(-0.171e-4), n(0.171e-4)],
        }
    }
}

impl<T: Real> Coefficients<T> {
    /// Coefficients of the tire of the Bombardier Iltis.
    #[must_use]
    pub fn iltis() -> Self {
        Self::iltis_by(T::from_f64)
    }
}

/// Side force of a tire with its slope, and aligning torque.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Side<T> {
    /// Side force Fy [N].
    pub force: T,
    /// Aligning torque Mz [N m].
    pub torque: T,
    /// -dFy/da, not negative [N/rad].
    pub stiffness: T,
}

/// Cornering stiffness -dFy/da of a wheel that rolls straight and upright at load `f` [N/rad]; not negative.
pub fn cornering_stiffness<T: Real>(c: &Coefficients<T>, f: T) -> T {
    side(c, f, T::ZERO, T::ZERO).stiffness
}

/// Side force and aligning torque at load `f` [N], slip angle and camber [rad]. Both are zero without load.
pub fn side<T: Real>(c: &Coefficients<T>, f: T, slip: T, camber: T) -> Side<T> {
    if !(f > T::ZERO) {
        return Side::default();
    }
    let [a0, a1, a2, a3, a4] = c.a;
    let mu = ((c.b[0] * f + c.b[1] + c.b[2] * f * f) * c.skid).max(T::from_f64(LEAST_FRICTION));
    let (shift, slope) = if f <= c.omega * a2 {
        let d = a1 * f * (f - a2) - a0 * a2;
        (-a2 * a3 * (a4 - f) * f / (a4 * d) * camber, d / (a2 * mu * f))
    } else {
        let edge = c.omega * a2;
        (a2 * a3 * c.omega * (a4 - edge) / (a0 * a4) * camber, -a0 / (mu * f))
    };
    let b = slope * (slip + shift);
    let three = T::TWO + T::ONE;
    let (size, third) = (b.abs(), T::ONE / three);
    let (share, rise) = if size < three {
        let cube = T::ONE / (three * three * three);
        (b - b * size * third + b * b * b * cube, {
            let r = T::ONE - size * third;
            r * r
        })
    } else {
        (b / size, T::ZERO)
    };
    let force = mu * f * share;
    Side {
        force,
        torque: (c.trail[0] * f + c.trail[1] * force.abs()) * force,
        stiffness: -mu * f * rise * slope,
    }
}
