//! An estimate of the error that a step makes, from the accelerations at its ends.
//!
//! ```text
//! position   q(t+h) - q_(n+1) = C h^2 (a_(n+1) - a_n) + O(h^4),   C = |beta - 1/6 + (am - af)/2|
//! velocity   v(t+h) - v_(n+1) = D h (a_(n+1) - a_n) + O(h^3),     D = |gamma - 1/2 + am - af|
//! ```
//!
//! For the trapezoidal rule C = 1/12 and D = 0 (Zienkiewicz and Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871-887). Accelerations
//! are the projected ones, so that the estimate sees the motion and not the constraints.

use crate::Real;
use crate::integrator::Integrator;

/// Coefficients of the estimate for an integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalError<T> {
    position: T,
    velocity: T,
}

impl<T: Real> LocalError<T> {
    /// For one-step methods of the Newmark and generalised-alpha families.
    pub fn new(integrator: &Integrator<T>) -> Self {
        let shift = integrator.alpha_m - integrator.alpha_f;
        let sixth = T::ONE / T::from_f64(6.0);
        Self {
            position: (integrator.beta - sixth + shift * T::HALF).abs(),
            velocity: (integrator.gamma - T::HALF + shift).abs(),
        }
    }

    /// The power of h that the estimate goes with.
    #[must_use]
    pub fn power(&self) -> u32 {
        /// Error coefficient of a velocity that is rounding of zero, in units of rounding [-]. Chosen, not tuned.
        const ROUNDINGS: f64 = 16.0;
        if self.velocity > T::EPSILON * T::from_f64(ROUNDINGS) { 2 } else { 3 }
    }

    /// Largest error of a coordinate [m or -] in a step `h` [s] from accelerations `from` to accelerations `to`.
    ///
    /// A velocity's error counts with the h over which it acts. NaN where an acceleration is.
    pub fn of(&self, h: T, from: &[T], to: &[T]) -> T {
        let mut most = T::ZERO;
        for (&a, &b) in from.iter().zip(to) {
            let change = (b - a).abs();
            // A NaN is taken, and then nothing is larger.
            if change > most || !(change >= T::ZERO) {
                most = change;
            }
        }
        (self.position + self.velocity) * h * h * most
    }
}
