//! Estimate of the local error of a step, from the accelerations at its ends.
//!
//! ```text
//! position   q(t+h) - q_(n+1) = C h^2 (a_(n+1) - a_n) + O(h^4),   C = |beta - 1/6 + (am - af)/2|
//! velocity   v(t+h) - v_(n+1) = D h (a_(n+1) - a_n) + O(h^3),     D = |gamma - 1/2 + am - af|
//! ```
//!
//! h is the step, n the index of its beginning; beta, gamma, am and af are parameters of the integrator. The trapezoidal rule has C = 1/12
//! and D = 0 (Zienkiewicz and Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871-887). The accelerations a are projected onto the constraints, so
//! that constraint violations do not enter the estimate.

use crate::Real;
use crate::integrator::Integrator;

/// Coefficients of the estimate for an integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalError<T> {
    position: T,
    velocity: T,
}

impl<T: Real> LocalError<T> {
    /// Coefficients for a one-step method of the Newmark or generalised-alpha family.
    pub fn new(integrator: &Integrator<T>) -> Self {
        let shift = integrator.alpha_m - integrator.alpha_f;
        let sixth = T::ONE / T::from_f64(6.0);
        Self {
            position: (integrator.beta - sixth + shift * T::HALF).abs(),
            velocity: (integrator.gamma - T::HALF + shift).abs(),
        }
    }

    /// Power of h to which the estimate is proportional.
    #[must_use]
    pub fn power(&self) -> u32 {
        /// Coefficient of the velocity error that counts as zero, in multiples of machine precision [-]. Chosen, not tuned.
        const ROUNDINGS: f64 = 16.0;
        if self.velocity > T::EPSILON * T::from_f64(ROUNDINGS) { 2 } else { 3 }
    }

    /// Largest error of a coordinate [m or -] in a step of `h` [s], from accelerations `from` at its beginning and `to` at its end.
    ///
    /// The error of a velocity counts as an error of position after one step h. The result is NaN if an acceleration is NaN.
    pub fn of(&self, h: T, from: &[T], to: &[T]) -> T {
        let mut most = T::ZERO;
        for (&a, &b) in from.iter().zip(to) {
            let change = (b - a).abs();
            // A NaN passes this test, and no later change exceeds it.
            if change > most || !(change >= T::ZERO) {
                most = change;
            }
        }
        (self.position + self.velocity) * h * h * most
    }
}
