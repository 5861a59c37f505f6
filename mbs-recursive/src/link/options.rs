//! Options that the caller chooses. The fields are public; start from [`Options::default`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Options of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the implicit step. Bounded steps accept integrators of the Newmark family only.
    pub integrator: Integrator<T>,
    /// Tolerance of the fixed-point iteration, relative to the displacement a dt²/2 that the accelerations make in the step [-].
    pub tolerance: T,
    /// Largest number of fixed-point iterations in a step.
    pub max_iterations: u32,
    /// Largest number of sweeps (iterations) of one projection.
    pub max_sweeps: u32,
    /// Method by which loops are closed.
    pub closure: Closure<T>,
    /// Error of one step with error control, relative and absolute [-]. Loops are closed to a hundredth of this error between steps, and to
    /// rounding at the end of a call.
    pub error: T,
    /// First step tried with error control [s]. `None`: the first step has the length of the call.
    pub first_step: Option<T>,
    /// Largest number of steps that a call with error control tries. A call fails earlier if the remaining time would take more than ten
    /// times this number of steps. This is checked after a tenth of this number of steps, but not before 10,000 steps.
    pub max_steps: u32,
    /// Regularisation ε that is added to the diagonal of Λ = J M⁻¹ Jᵀ, relative to the scale of each row [-].
    pub regularisation: T,
}

/// Method by which loops are closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Closure<T> {
    /// Multipliers that satisfy Φ̈ = 0 to rounding. Positions and velocities are projected after each step.
    Constraints,
    /// Closure forces of the report, λ = α (Φ̈ + 2 μ Ω Φ̇ + Ω² Φ) [P3 (39)-(41)], without projections.
    Report {
        /// Penalty α of the closure forces [kg].
        alpha: T,
        /// Frequency Ω of the stabilisation [1/s].
        omega: T,
        /// Damping ratio μ [-].
        mu: T,
    },
}

impl<T: Real> Closure<T> {
    /// Returns the report's closure with its values α = 1e7, Ω = 10, μ = 1.
    #[must_use]
    pub fn report() -> Self {
        // values of the report for [P3 (39)-(41)]
        let [alpha, omega] = [1e7, 10.0].map(T::from_f64);
        Self::Report { alpha, omega, mu: T::ONE }
    }
}

impl<T: Real> Default for Options<T> {
    /// Returns the default options. The trapezoidal rule has tolerance 1e-10 (in single precision 64 times machine precision), 50
    /// iterations and 30 sweeps. Error control has error 1e-8 and a million steps. The regularisation is ε = √(machine precision) / 256.
    fn default() -> Self {
        /// Default tolerance of corrections, relative to the displacement by accelerations in a step [-].
        const TOLERANCE: f64 = 1e-10;
        /// Default error of a step with error control, relative to the size of a component [-].
        const ERROR: f64 = 1e-8;
        /// Smallest tolerance and error, in units of machine precision [-]. This limit is larger than the defaults in single precision
        /// only. Chosen, not tuned.
        const ROUNDINGS: f64 = 64.0;
        /// Regularisation of the rows of loops, in units of the square root of machine precision [-]. Chosen, not tuned.
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
