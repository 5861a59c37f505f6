//! Options that the caller chooses. Public fields; start from the defaults.

use mbs_core::Real;
use mbs_core::step::OptionError;

/// Choices for the search of an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Largest residual force that counts as balanced, relative to the largest sum of absolute forces on a coordinate [-].
    /// The search continues to machine precision where it can.
    pub tolerance: T,
    /// Number of factorisations allowed.
    pub max_factorizations: u32,
}

impl<T: Real> Default for Options<T> {
    /// Default tolerance of 1e-9 (f32: 1e-4), at most 2000 factorisations: a fall over many times the scene's length ends before.
    fn default() -> Self {
        /// Tolerance of forces [-]. Chosen, not tuned.
        const TOLERANCE: f64 = 1e-9;
        /// Least tolerance, in units of rounding [-]: it counts in single precision alone. Chosen, not tuned.
        const ROUNDINGS: f64 = 1e3;
        Self {
            tolerance: T::from_f64(TOLERANCE).max(T::EPSILON * T::from_f64(ROUNDINGS)),
            max_factorizations: 2000,
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
        if self.max_factorizations == 0 {
            return Err(OptionError::NotPositive("max_factorizations"));
        }
        Ok(())
    }
}

/// Choices for a linearisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearOptions<T> {
    /// Largest change of a coordinate in a difference, relative to the scene's length [-]; of a velocity, the same per second.
    pub step: T,
}

impl<T: Real> Default for LinearOptions<T> {
    /// Default step of 1e-4 (f32: 1e-2): the fourth power of it, the error of the differences, is below rounding in smooth forces.
    fn default() -> Self {
        /// Difference of coordinates in double precision [-]: its fourth power is rounding.
        const STEP: f64 = 1e-4;
        Self { step: T::from_f64(STEP).max(T::from_f64(0.5) * T::EPSILON.sqrt().sqrt()) }
    }
}

impl<T: Real> LinearOptions<T> {
    /// Checks the range of the step.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    pub fn validate(&self) -> Result<(), OptionError> {
        if self.step > T::ZERO && self.step.is_finite() {
            Ok(())
        } else {
            Err(OptionError::NotPositive("step"))
        }
    }
}
