//! Options that the caller chooses. Start from [`Options::index3`] or [`Options::index1`] and change the public fields as needed.

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Tolerance of the iterations, relative to the displacement by accelerations in a step [-]. Corrections below it are rounding errors of the
/// forces in most scenes.
const TOLERANCE: f64 = 1e-10;
/// Smallest allowed tolerance [EPSILON]: six binary digits are left for rounding errors.
const MIN_TOLERANCE: f64 = 64.0;
/// Largest number of iterations of a step [-]. Regular steps need two or three.
const MAX_ITERATIONS: u32 = 20;
/// Largest number of sweeps of a projection [-]. One sweep is exact unless the factor is from another configuration or delta is not zero.
const MAX_SWEEPS: u32 = 12;
/// Smallest pivot of independent rows, relative to the sum of absolute values of its terms [-]. Pivots are proportional to the square of
/// the angle between rows, so rows within 1e-6 rad of dependence are refused.
const RANK: f64 = 1e-12;
/// Smallest allowed value of the option `rank` [EPSILON]. It is the cancellation error in a row of some hundred entries.
const MIN_RANK: f64 = 300.0;

/// Options of a step in either index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the steps.
    pub integrator: Integrator<T>,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step [-].
    pub tolerance: T,
    /// Largest number of iterations of one step.
    pub max_iterations: u32,
    /// Largest number of sweeps in one projection. The step fails if the violation is still too large after them.
    pub max_sweeps: u32,
    /// Smallest allowed ratio of a pivot to the sum of absolute values of its terms, in the equilibrated saddle matrix [-]. If the weakest
    /// pivot is below it, rank is lost.
    ///
    /// The ratio is proportional to the square of the sine of the angle between a row and the other rows. The default of 1e-12 refuses rows
    /// within 1e-6 rad of dependence. At larger angles, a step that may leave its branch is refused too.
    pub rank: T,
    /// Regularisation delta on the diagonal of the constraint rows, in units of 1 / (effective mass of the row) [-]. A value of 1e-8 allows
    /// redundant rows, at the cost of a few more sweeps.
    ///
    /// The multipliers are iterated (proximal point method), so that delta does not change the solution. Steps through singular positions
    /// are better without delta. `None` sets delta to zero, and lost rank is then an error.
    pub regularisation: Option<T>,
    /// Method by which index-1 limits the violation of its constraints.
    pub stabilisation: Stabilisation<T>,
    /// Adds the geometric stiffness of the constraints to the tangent of index-3.
    pub geometric_stiffness: bool,
    /// Evaluates phi by increments and stores q as a compensated pair.
    pub compensated: bool,
}

/// Method by which index-1 limits the violation of its constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stabilisation<T> {
    /// No stabilisation: the violation phi grows with time.
    None,
    /// Baumgarte's stabilisation: phi'' + 2 alpha phi' + beta^2 phi = 0 instead of phi'' = 0 (Baumgarte, 1972).
    Baumgarte {
        /// Damping of the violation [1/s].
        alpha: T,
        /// Frequency of the violation [1/s]; equal to alpha for critical damping.
        beta: T,
    },
    /// Positions, velocities and accelerations are projected after every step.
    Projection,
}

impl<T: Real> Options<T> {
    /// Returns the defaults of index-3: trapezoidal rule, tolerance 1e-10, at most 20 iterations. Two or three iterations are usual.
    #[must_use]
    pub fn index3() -> Self {
        Self {
            integrator: Integrator::trapezoidal(),
            tolerance: T::tolerance(TOLERANCE).max(T::EPSILON * T::from_f64(MIN_TOLERANCE)),
            max_iterations: MAX_ITERATIONS,
            max_sweeps: MAX_SWEEPS,
            rank: T::tolerance(RANK).max(T::EPSILON * T::from_f64(MIN_RANK)),
            regularisation: None,
            stabilisation: Stabilisation::Projection,
            geometric_stiffness: true,
            compensated: true,
        }
    }

    /// Returns the defaults of index-1: those of index-3, with a projection after every step.
    #[must_use]
    pub fn index1() -> Self {
        Self::index3()
    }

    /// Checks the ranges of the options.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    pub fn validate(&self) -> Result<(), OptionError> {
        let mut positive = [
            ("tolerance", self.tolerance),
            ("rank", self.rank),
            ("regularisation", self.regularisation.unwrap_or(T::ONE)),
            ("stabilisation.alpha", T::ONE),
            ("stabilisation.beta", T::ONE),
        ];
        if let Stabilisation::Baumgarte { alpha, beta } = self.stabilisation {
            (positive[3].1, positive[4].1) = (alpha, beta);
        }
        for (name, value) in positive {
            if !(value > T::ZERO && value.is_finite()) {
                return Err(OptionError::NotPositive(name));
            }
        }
        for (name, value) in
            [("max_iterations", self.max_iterations), ("max_sweeps", self.max_sweeps)]
        {
            if value == 0 {
                return Err(OptionError::NotPositive(name));
            }
        }
        Ok(())
    }
}
