//! Drag of still air on a point.
//!
//! ```text
//! F = -1/2 rho C_d A |v| v
//! ```
//!
//! Range: turbulent flow around blunt bodies, where C_d is constant. All power is dissipated.

use super::body::{Action, BodyMotion};
use super::scalar::Measure;
use crate::Real;
use crate::algebra::{Vector, norm};

/// The drag's size [N] at a speed [m/s], and its derivative by the speed [N s/m]; `area_coefficient` is C_d A [m^2].
#[inline]
pub fn drag<T: Real>(area_coefficient: T, density: T, speed: T) -> (T, T) {
    let k = area_coefficient * density * T::HALF;
    (k * speed * speed, T::TWO * k * speed)
}

/// The drag on a body's point; without speed there is no drag and no direction.
pub(crate) fn action<T: Real>(
    area_coefficient: T,
    density: T,
    motion: &BodyMotion<T>,
) -> Action<T> {
    let velocity = Vector::<T, 3>::from(motion.velocity);
    let speed = norm(&velocity);
    let direction =
        if speed > T::ZERO { velocity * (T::ONE / speed) } else { Vector::<T, 3>::zeros() };
    let (tension, damping) = drag(area_coefficient, density, speed);
    let measure = Measure { rate: speed, tension, damping, ..Measure::default() };
    Action { force: direction.into(), moment: [T::ZERO; 3], measure }
}
