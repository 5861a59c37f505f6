//! Options that the caller chooses. Start from the defaults and change the public fields as needed.

use mbs_core::Real;
use mbs_core::step::OptionError;

/// Options of the search for an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Largest residual force that counts as balanced, relative to a reference force [-]. The reference is the largest sum of absolute
    /// forces on a coordinate, plus the force that the stiffness gives for a displacement of the scene's length. The search continues to
    /// machine precision if steps still reduce the forces.
    pub tolerance: T,
    /// Largest number of factorisations of a search; the search fails if it needs more.
    pub max_factorizations: u32,
}

impl<T: Real> Default for Options<T> {
    /// Returns the defaults: tolerance 1e-9 (f32: 1e-4), at most 2000 factorisations. Even a fall over many times the scene's length needs
    /// fewer.
    fn default() -> Self {
        /// Tolerance of forces [-]. Chosen, not tuned.
        const TOLERANCE: f64 = 1e-9;
        /// Least tolerance, in units of EPSILON [-]. It has an effect in single precision only. Chosen, not tuned.
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

/// Options of a linearisation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearOptions<T> {
    /// Largest change of a coordinate in a difference, relative to the scene's length [-]. The change of velocities has the same value per
    /// second.
    pub step: T,
}

impl<T: Real> Default for LinearOptions<T> {
    /// Returns the default step of 1e-4 (f32: 1e-2). The error of the differences is of the fourth power of the step. For smooth forces it
    /// is below rounding errors.
    fn default() -> Self {
        /// Difference of coordinates in double precision [-]: its fourth power is at machine precision.
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
