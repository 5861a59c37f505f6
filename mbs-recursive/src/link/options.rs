//! Options that the caller chooses. Public fields; start from [`Options::default`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Choices for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the implicit step; bounded steps take one of the Newmark family.
    pub integrator: Integrator<T>,
    /// A correction below this times the step's own displacement a dt²/2 is small [-].
    pub tolerance: T,
    /// Fixed-point iterations allowed in one step.
    pub max_iterations: u32,
    /// Sweeps after which a projection must have reached its level.
    pub max_sweeps: u32,
    /// Method by which loops are closed.
    pub closure: Closure<T>,
    /// Error of one step with error control, relative and absolute [-]; loops hold to a hundredth of it until the end of a call,
    /// and to rounding there.
    pub error: T,
    /// First step tried with error control [s]; the whole length asked for where left out.
    pub first_step: Option<T>,
    /// Steps tried with error control within the length asked for; after ten thousand and a tenth of these a call ends where the rest
    /// would take ten times as many.
    pub max_steps: u32,
    /// ε in Λ + ε, relative to the rows' own scale [-].
    pub regularisation: T,
}

/// Method by which loops are closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Closure<T> {
    /// Multipliers that meet Φ̈ = 0 to rounding; positions and velocities projected after each step.
    Constraints,
    /// The report's closure forces λ = α (Φ̈ + 2 μ Ω Φ̇ + Ω² Φ) [P3 (39)-(41)], without projections.
    Report {
        /// Penalty α [kg].
        alpha: T,
        /// Frequency Ω [1/s].
        omega: T,
        /// Damping ratio μ.
        mu: T,
    },
}

impl<T: Real> Closure<T> {
    /// The report's closure with its α = 1e7, Ω = 10, μ = 1.
    #[must_use]
    pub fn report() -> Self {
        // [P3 (39)-(41)]
        let [alpha, omega] = [1e7, 10.0].map(T::from_f64);
        Self::Report { alpha, omega, mu: T::ONE }
    }
}

impl<T: Real> Default for Options<T> {
    /// Returns the trapezoidal rule; tolerance 1e-10 (64 roundings in single precision); 50 iterations, 30 sweeps; error 1e-8, a million
    /// steps; ε = √rounding / 256.
    fn default() -> Self {
        /// Tolerance of corrections, relative to the displacement by accelerations in a step [-].
        const TOLERANCE: f64 = 1e-10;
        /// Error of a step of an explicit method, relative to the size of a component [-].
        const ERROR: f64 = 1e-8;
        /// Least tolerance and error, in units of rounding [-]: it counts in single precision alone. Chosen, not tuned.
        const ROUNDINGS: f64 = 64.0;
        /// Regularisation of the rows of loops, in roots of rounding [-]. Chosen, not tuned.
        const REGULARISATION: f64 = 1.0 / 256.0;
        let least = T::EPSILON * T::from_f64(ROUNDINGS);
        Self {
            integrator: Integrator::trapezoidal(),
            tolerance: T::tolerance(TOLERANCE).max(least),
            max_iterations: 50,
            max_sweeps: 30,
            closure: Closure::Constraints,
            error: T::from_f64(ERROR).max(least),
            first_step: None,
            max_steps: 1_000_000,
            regularisation: T::EPSILON.sqrt() * T::from_f64(REGULARISATION),
        }
    }
}

impl<T: Real> Options<T> {
    /// Checks the ranges of the options.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    pub fn validate(&self) -> Result<(), OptionError> {
        let positive = |name, value: T| {
            let is_positive = value > T::ZERO && value.is_finite();
            if is_positive { Ok(()) } else { Err(OptionError::NotPositive(name)) }
        };
        let some = |name, count| {
            if count > 0 { Ok(()) } else { Err(OptionError::NotPositive(name)) }
        };
        match self.closure {
            Closure::Constraints => positive("regularisation", self.regularisation)?,
            Closure::Report { alpha, omega, mu } => {
                positive("alpha", alpha)?;
                positive("omega", omega)?;
                positive("mu", mu)?;
            }
        }
        positive("tolerance", self.tolerance)?;
        positive("error", self.error)?;
        positive("first_step", self.first_step.unwrap_or(T::ONE))?;
        some("max_iterations", self.max_iterations)?;
        some("max_sweeps", self.max_sweeps)?;
        some("max_steps", self.max_steps)
    }
}
