//! Options that the caller chooses. Public fields; start from [`Options::index3`] or [`Options::index1`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Tolerance of the iterations [displacement by accelerations in a step]: below it a correction is at the rounding of forces in most scenes.
const TOLERANCE: f64 = 1e-10;
/// The least tolerance [EPSILON]: six binary digits are left to rounding.
const MIN_TOLERANCE: f64 = 64.0;
/// Most iterations of a step [-]: regular steps need two or three.
const MAX_ITERATIONS: u32 = 20;
/// Sweeps of a projection [-]: one is exact but for a factor of a near configuration and for delta.
const MAX_SWEEPS: u32 = 12;
/// Weakest pivot of rows that count as independent [part of what the pivot is the sum of]: within 1e-6 rad of being dependent, as it goes
/// with the square.
const RANK: f64 = 1e-12;
/// The least of these [EPSILON]: what cancellation leaves in a row of some hundred entries.
const MIN_RANK: f64 = 300.0;

/// Choices for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the steps.
    pub integrator: Integrator<T>,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step [-].
    pub tolerance: T,
    /// Iterations allowed in one step.
    pub max_iterations: u32,
    /// Sweeps of a projection after which its level must be reached.
    pub max_sweeps: u32,
    /// The constraints count as having lost rank when the weakest pivot of the equilibrated saddle matrix is below this times
    /// what it is the sum of [-]. It goes with the square of the sine of the angle between a row and the others: the default
    /// of 1e-12 refuses rows within 1e-6 rad of being dependent. Farther off, a step that may leave its branch is refused too.
    pub rank: T,
    /// delta on the diagonal of the rows, in units of 1 / (effective mass of the row) [-]; the multipliers are iterated
    /// (proximal shift), so that the solution is the exact one. Tolerates redundant rows at the price of a few sweeps more;
    /// 1e-8 does. It does not help through singular positions, which are passed best without. `None`: zero, and lost rank is
    /// an error.
    pub regularisation: Option<T>,
    /// Method that keeps index-1 on its constraints.
    pub stabilisation: Stabilisation<T>,
    /// Put the geometric stiffness of the constraints into the tangent of index-3.
    pub geometric_stiffness: bool,
    /// Evaluate phi by increments and carry q as a compensated pair.
    pub compensated: bool,
}

/// Method that keeps index-1 on its constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stabilisation<T> {
    /// No method of stabilisation: phi grows with time.
    None,
    /// phi'' + 2 alpha phi' + beta^2 phi = 0 instead of phi'' = 0 (Baumgarte, 1972).
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
    /// Returns the defaults of index-3: trapezoidal rule, tolerance 1e-10, at most 20 iterations, 2 or 3 are usual.
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

    /// Returns the defaults of index-1: as index-3, projected after every step.
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
