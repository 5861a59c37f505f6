//! One-sided contact, which pushes while it is pressed in, and never pulls.
//!
//! ```text
//! F = max(0, k x + c x' s(x)),   s = 3 r^2 - 2 r^3,   r = min(1, x / x_s)        x > 0 pressed in
//! V = k x^2 / 2 for x > 0
//! ```
//!
//! The damper fades in over the depth x_s, so that the force is continuous where contact begins. Source: the one-sided Kelvin-Voigt
//! model that Hunt and Crossley (1975) discuss, with a fade in place of their product. Range: if c |x'| is much above k x_s, steps
//! must resolve the time x_s / |x'|.

use super::operations::Operations;
use crate::Real;

/// Depth over which the damper fades in [m or rad], so that the force does not jump at first contact. Chosen, not tuned.
pub const FADE: f64 = 1e-3;

/// Operations of [`contact`], with those of the fade.
pub const OPERATIONS: Operations = Operations::new(14, 6);

/// Contact force, and its derivatives by depth and by rate. All are zero without contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contact<T> {
    /// Contact force F, not negative [N or N m].
    pub force: T,
    /// Derivative dF/dx by the depth, not negative [N/m or N m/rad].
    pub stiffness: T,
    /// Derivative dF/dx' by the rate [N s/m or N m s/rad].
    pub damping: T,
}

/// Contact force at depth `x` [m or rad] and rate `rate`, positive while pressing in [m/s or rad/s].
#[inline]
pub fn contact<T: Real>([stiffness, damping]: [T; 2], x: T, rate: T) -> Contact<T> {
    if !(x > T::ZERO) {
        return Contact::default();
    }
    let (share, slope) = if damping > T::ZERO { fade(x) } else { (T::ZERO, T::ZERO) };
    let force = stiffness * x + damping * share * rate;
    if !(force > T::ZERO) {
        return Contact::default();
    }
    // The fade contributes to the stiffness only where it stiffens, so that the tangent stays stable.
    let growth = (damping * slope * rate).max(T::ZERO);
    Contact { force, stiffness: stiffness + growth, damping: damping * share }
}

/// Fade s(x) of the damper, and its slope.
fn fade<T: Real>(x: T) -> (T, T) {
    let inverse = T::ONE / T::from_f64(FADE);
    let r = x * inverse;
    if r >= T::ONE {
        return (T::ONE, T::ZERO);
    }
    let three = T::TWO + T::ONE;
    (r * r * (three - T::TWO * r), three * T::TWO * r * (T::ONE - r) * inverse)
}

/// Energy that the contact stores at depth `x` [J].
#[inline]
pub fn energy<T: Real>(stiffness: T, x: T) -> T {
    if x > T::ZERO { stiffness * x * x * T::HALF } else { T::ZERO }
}
