//! Options that the caller chooses. Public fields; start from [`Options::default`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Choices for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator, applied to z.
    pub integrator: Integrator<T>,
    /// Choice of the coordinates z.
    pub coordinates: Coordinates,
    /// A correction below this times the displacement that accelerations cause in the step is small [-].
    pub tolerance: T,
    /// Newton iterations allowed in one step.
    pub max_iterations: u32,
    /// When independent coordinates are chosen anew.
    pub pivot_change: PivotChange,
    /// Put the geometric stiffness of the constraints, the curvature of their surface, into the tangent; P1 (44) has none.
    pub geometric_stiffness: bool,
}

/// The independent coordinates z that the integrator advances.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinates {
    /// Coordinates in the tangent plane of the constraints at the middle of the step, orthogonal in the metric of the mass:
    /// z = C^T q, C = M R there. The motion does not depend on which columns are independent.
    Tangent,
    /// The independent columns themselves [P1 (40)]. The motion depends on them within the error of the integrator.
    Chosen,
}

/// When independent coordinates are chosen anew, always between steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PivotChange {
    /// When a pivot fell below a hundredth of what it was, R grew above 10, or the position problem took more than 4 iterations.
    WhenNeeded,
    /// Always, at every step.
    EveryStep,
}

impl<T: Real> Default for Options<T> {
    /// The trapezoidal rule, tolerance 1e-10, at most 20 iterations.
    fn default() -> Self {
        /// Tolerance of corrections [-].
        const TOLERANCE: f64 = 1e-10;
        /// Least tolerance, in units of rounding [-]: it counts in single precision alone. Chosen, not tuned.
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
