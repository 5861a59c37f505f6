//! Violations r of the velocity and acceleration constraints, and the size that a projection may leave.
//!
//! ```text
//! r = J v + phi_t,      r = J a + bias
//! ```

use super::{StepEnd, check_guides};
use crate::Real;
use crate::model::{Model, Terms};
use crate::step::{StepError, largest};
use crate::team::{add, norm_inf};

/// Accepted violation if no further sweep reduces it, relative to the sizes of the vector and the scene [-]. It is five digits smaller than
/// the error of steps of practical length.
const ACCEPTED: f64 = 5e-10;
/// Accepted violation at limited precision, relative as `ACCEPTED` [EPSILON]. It allows for sums over the coordinates of a long chain of
/// bodies.
const ACCEPTED_ROUNDING: f64 = 1024.0;
/// Violation of velocities at machine precision [EPSILON of the largest velocity]: each constraint row contains a few products.
const VELOCITY_ROUNDING: f64 = 16.0;
/// Violation of accelerations at machine precision [EPSILON of the largest acceleration or bias]: the bias contains squares of velocities.
const ACCELERATION_ROUNDING: f64 = 1024.0;
/// Violation of positions at machine precision [EPSILON of the scene's length], first without, then with compensated sums. With compensated
/// sums it is a hundredth of the last digit.
const POSITION_ROUNDING: [f64; 2] = [4.0, 0.01];
/// Accepted violation of positions if the tolerance of the step is smaller than this value [EPSILON of the scene's length].
const POSITION_ACCEPTED: f64 = 256.0;

/// Level of the constraints onto which a vector is projected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// Velocity constraints: J v + phi_t = 0.
    Velocity,
    /// Acceleration constraints: J a + bias = 0.
    Acceleration,
}

/// Limits of the violation that a projection may leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualLimits<T> {
    /// Violation that is small enough without any sweep.
    pub goal: T,
    /// Violation at which sweeps end.
    pub enough: T,
    /// Violation that is accepted if further sweeps do not reduce it.
    pub limit: T,
    /// Size with which the violation is compared: the size of the vector plus a reference size that is not zero.
    pub size: T,
}

impl<T: Real> ResidualLimits<T> {
    /// Limits for phi [m] in a scene of this `length` [m]. The iteration computes positions to its `tolerance`, so a violation below it is
    /// accepted if no sweep reduces it.
    pub fn of_positions(length: T, tolerance: T, compensated: bool) -> Self {
        let goal = length * T::EPSILON * T::from_f64(POSITION_ROUNDING[usize::from(compensated)]);
        let limit = length * tolerance.max(T::EPSILON * T::from_f64(POSITION_ACCEPTED));
        Self { goal, enough: goal, limit, size: length }
    }

    /// Checks that `violation`, after sweeps of positions, is below its limit or at most `rounding`.
    ///
    /// # Errors
    /// [`StepError::Violated`] with the most violated row of `phi`.
    pub fn check_positions(&self, violation: T, rounding: T, phi: &[T]) -> Result<(), StepError> {
        if violation <= self.limit.max(rounding) {
            return Ok(());
        }
        Err(StepError::Violated { level: 0, violation: violation.to_f64(), row: largest(phi) })
    }
}

impl ConstraintLevel {
    /// Evaluates phi_t at q, or the bias at (q, v), and returns the limits of the violation. `length` is the scene's length [m];
    /// accelerations must be in [m/s^2].
    ///
    /// # Errors
    /// [`StepError::OppositeBranch`] of a guided angle, at the velocity level.
    #[inline]
    pub fn limits<T: Real, M: Model<T>>(
        self,
        model: &M,
        end: &StepEnd<T>,
        length: T,
        terms: &mut Terms<T>,
    ) -> Result<ResidualLimits<T>, StepError> {
        let norm = |x: &[T]| norm_inf(model.team(), &x[..end.moved().len()]);
        let (own, from_zero, rounding) = match self {
            Self::Velocity => {
                if model.has_guides() {
                    model.evaluate_phi_t(&end.q, terms);
                    check_guides(model, &end.q, terms)?;
                }
                (norm(&end.v), length, VELOCITY_ROUNDING)
            }
            Self::Acceleration => {
                model.evaluate_bias(&end.q, &end.v, terms);
                let bias = norm_inf(model.team(), &terms.phi_bias);
                (norm(&end.a).max(bias), T::ONE, ACCELERATION_ROUNDING)
            }
        };
        let size = from_zero + own;
        let accepted = T::from_f64(ACCEPTED).max(T::EPSILON * T::from_f64(ACCEPTED_ROUNDING));
        let goal = own * T::EPSILON * T::from_f64(rounding);
        Ok(ResidualLimits { goal, enough: goal, limit: size * accepted, size })
    }

    /// Computes rates = J x + b, where b is phi_t or the bias of phi''. Returns the largest absolute rate.
    #[inline]
    pub fn violation<T: Real, M: Model<T>>(
        self,
        model: &M,
        terms: &Terms<T>,
        x: &[T],
        rates: &mut [T],
    ) -> T {
        model.multiply_jacobian(terms, x, rates);
        match self {
            Self::Velocity if !model.has_guides() => {}
            Self::Velocity => add(model.team(), rates, &terms.phi_t),
            Self::Acceleration => add(model.team(), rates, &terms.phi_bias),
        }
        norm_inf(model.team(), rates)
    }

    /// Error of a projection that left the violation `violation`. The error names the row with the largest of the `rates`.
    #[cold]
    pub fn violated<T: Real>(self, violation: T, rates: &[T]) -> StepError {
        let level = if self == Self::Velocity { 1 } else { 2 };
        StepError::Violated { level, violation: violation.to_f64(), row: largest(rates) }
    }
}
