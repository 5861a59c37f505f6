//! Violations of the constraints of velocities and accelerations, and what a projection may leave of them.
//!
//! ```text
//! r = J v + phi_t,      r = J a + bias
//! ```

use super::{StepEnd, check_guides};
use crate::Real;
use crate::model::{Model, Terms};
use crate::step::{StepError, largest};
use crate::team::{add, norm_inf};

/// Violation that is accepted when no sweep lowers it further, relative to what the vector and the scene move [-]: five digits more
/// than steps of practical length are exact to.
const ACCEPTED: f64 = 5e-10;
/// Violation that is accepted where rounding decides, relative as `ACCEPTED` is [EPSILON]: sums over the coordinates of a long row of bodies.
const ACCEPTED_ROUNDING: f64 = 1024.0;
/// A violation of velocities that is rounding [EPSILON of the largest velocity]: some products in a row.
const VELOCITY_ROUNDING: f64 = 16.0;
/// A violation of accelerations that is rounding [EPSILON of the largest acceleration or bias]: the bias squares velocities.
const ACCELERATION_ROUNDING: f64 = 1024.0;
/// A violation of positions that is rounding [EPSILON of the scene's length]: where increments are carried, a hundredth of the last digit.
const POSITION_ROUNDING: [f64; 2] = [4.0, 0.01];
/// A violation of positions that is accepted where the tolerance of the step is finer [EPSILON of the scene's length].
const POSITION_ACCEPTED: f64 = 256.0;

/// Constraints that a vector is projected on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ConstraintLevel {
    /// J v + phi_t = 0.
    Velocity,
    /// J a + bias = 0.
    Acceleration,
}

/// How much of a violation a projection may leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualLimits<T> {
    /// A violation that is not swept at all.
    pub goal: T,
    /// Violation that sweeps may leave.
    pub enough: T,
    /// Violation that sweeps may leave where they no longer shrink it.
    pub limit: T,
    /// Size that the violation is compared with: that of the vector, with what keeps it from zero.
    pub size: T,
}

impl<T: Real> ResidualLimits<T> {
    /// Of phi [m], in a scene of this `length` [m]. The iteration knows positions to its `tolerance`: a residual below it that no sweep
    /// lowers says nothing more.
    pub fn of_positions(length: T, tolerance: T, compensated: bool) -> Self {
        let goal = length * T::EPSILON * T::from_f64(POSITION_ROUNDING[usize::from(compensated)]);
        let limit = length * tolerance.max(T::EPSILON * T::from_f64(POSITION_ACCEPTED));
        Self { goal, enough: goal, limit, size: length }
    }

    /// Is what sweeps of positions left, `violation`, as little as it has to be, or at most `rounding`?
    ///
    /// # Errors
    /// [`StepError::Violated`] with the row of `phi`.
    pub fn check_positions(&self, violation: T, rounding: T, phi: &[T]) -> Result<(), StepError> {
        if violation <= self.limit.max(rounding) {
            return Ok(());
        }
        Err(StepError::Violated { level: 0, violation: violation.to_f64(), row: largest(phi) })
    }
}

impl ConstraintLevel {
    /// Evaluates phi_t at q, or the bias at (q, v), and says how much of a violation may be left, in a scene of this `length` [m]. Needs
    /// accelerations in [m/s^2].
    ///
    /// # Errors
    /// [`StepError::OppositeBranch`] of a guided angle, with the velocities.
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

    /// rates = J x + b; returns their largest absolute value.
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

    /// A projection did not reach its level: `violation` is left, most of it in one of the rows of `rates`.
    #[cold]
    pub fn violated<T: Real>(self, violation: T, rates: &[T]) -> StepError {
        let level = if self == Self::Velocity { 1 } else { 2 };
        StepError::Violated { level, violation: violation.to_f64(), row: largest(rates) }
    }
}
