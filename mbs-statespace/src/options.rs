//! Options that the caller chooses. Start from [`Options::default`] and change the public fields as needed.

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Options of a step in state space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator, applied to z.
    pub integrator: Integrator<T>,
    /// Kind of the independent coordinates z.
    pub coordinates: Coordinates,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step [-].
    pub tolerance: T,
    /// Largest number of Newton iterations in one step.
    pub max_iterations: u32,
    /// Condition on which independent coordinates are chosen again.
    pub pivot_change: PivotChange,
    /// Adds the geometric stiffness of the constraints, which is the curvature of the constraint surface, to the tangent. P1 (44) has no
    /// such term.
    pub geometric_stiffness: bool,
}

/// The independent coordinates z that the integrator advances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Coordinates in the tangent plane of the constraints at the middle of the step, orthogonal in the metric of the mass:
    /// z = C^T q with C = M R there. The motion does not depend on the choice of independent columns.
    Tangent,
    /// The independent columns themselves [P1 (40)]. The choice of columns then changes the motion within the error of the integrator.
    Chosen,
}

/// Condition on which independent coordinates are chosen again, always between steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PivotChange {
    /// When a pivot fell to a hundredth of its size at the choice, R grew above 10, or the position problem took more than 4 iterations.
    WhenNeeded,
    /// Always, before every step.
    EveryStep,
}

impl<T: Real> Default for Options<T> {
    /// Returns the defaults: trapezoidal rule, tolerance 1e-10, at most 20 iterations.
    fn default() -> Self {
        /// Tolerance of corrections [-].
        const TOLERANCE: f64 = 1e-10;
        /// Smallest allowed tolerance, in units of EPSILON [-]. It has an effect in single precision only. Chosen, not tuned.
        const ROUNDINGS: f64 = 64.0;
        Self {
            integrator: Integrator::trapezoidal(),
            coordinates: Coordinates::Tangent,
            tolerance: T::tolerance(TOLERANCE).max(T::EPSILON * T::from_f64(ROUNDINGS)),
            max_iterations: 20,
            pivot_change: PivotChange::WhenNeeded,
            geometric_stiffness: true,
        }
    }
}

impl<T: Real> Options<T> {
    /// Checks the ranges of the options.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    pub fn validate(&self) -> Result<(), OptionError> {
        if !(self.tolerance > T::ZERO && self.tolerance.is_finite()) {
            return Err(OptionError::NotPositive("tolerance"));
        }
        if self.max_iterations == 0 {
            return Err(OptionError::NotPositive("max_iterations"));
        }
        Ok(())
    }
}
