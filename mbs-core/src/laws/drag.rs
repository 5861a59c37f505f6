//! Drag of still air on a point.
//!
//! ```text
//! F = -1/2 rho C_d A |v| v
//! ```
//!
//! Range: turbulent flow around blunt bodies, where C_d is constant. All power is dissipated.

use crate::Real;

/// The drag's size [N] at a speed [m/s], and its derivative by the speed [N s/m]; `area_coefficient` is C_d A [m^2].
#[inline]
pub fn drag<T: Real>(area_coefficient: T, density: T, speed: T) -> (T, T) {
    let k = area_coefficient * density * T::HALF;
    (k * speed * speed, T::TWO * k * speed)
}
