//! Options that the caller chooses. Start from [`Options::index3`] or [`Options::index1`] and change the public fields as needed.

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Penalty c in double precision and finer [effective masses]. One sweep reduces a violation to 1e-6 of its size. In the sum of mass and
/// penalty, 10 of 16 digits remain for the mass. Values of 1e2 to 1e8 work in regular motion.
const PENALTY: f64 = 1e6;
/// Penalty c in coarser scalars [effective masses]: the square root of 1/EPSILON in f32. Half of the digits remain for the mass, half for
/// the penalty.
const PENALTY_OF_SINGLE: f64 = 3e3;
/// EPSILON from which a scalar counts as coarse [-]: between that of f64 and that of f32.
const COARSE: f64 = 1e-12;
/// Tolerance of the iterations, relative to the displacement by accelerations in a step [-]. Corrections below it are rounding errors of the
/// forces in most scenes.
const TOLERANCE: f64 = 1e-10;
/// Smallest allowed tolerance [EPSILON]: six binary digits are left for rounding errors.
const MIN_TOLERANCE: f64 = 64.0;
/// Fraction of the first correction that the iteration may leave where effects act [-]. At 1e-6 the energy error of a vehicle that steers at
/// 30 m/s doubles; at 3e-7 it grows by a seventh.
const TRUNCATION_SHARE: f64 = 3e-7;
/// Largest number of iterations of index-3 [-]. Steps through singular positions take up to 20.
const MAX_ITERATIONS: u32 = 40;
/// Largest number of iterations of index-1 [-]. At a singular position, further iterations lead away from the solution.
const MAX_ITERATIONS_OF_INDEX1: u32 = 4;
/// Largest number of sweeps of a projection in index-3 [-]. If a sweep leaves more than a tenth of the violation, penalties are raised. So
/// twelve sweeps give twelve digits.
const MAX_SWEEPS: u32 = 12;
/// Largest number of sweeps of a projection in index-1 [-]. Its projections of positions start from larger violations than those of
/// index-3.
const MAX_SWEEPS_OF_INDEX1: u32 = 20;

/// Options of a step in either index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the steps.
    pub integrator: Integrator<T>,
    /// Penalty on the constraints.
    pub penalty: Penalty<T>,
    /// Tolerance of the iterations [-]. In index-3 it is relative to the displacement by accelerations in a step, in index-1 to the
    /// accelerations.
    pub tolerance: T,
    /// The iteration of index-3 also ends below this fraction of the first correction of a step, where effects act [-].
    ///
    /// The fraction is compared with the predicted next correction, which counts as at least a tenth of the last one. The first correction
    /// is three times the local error of the trapezoidal rule. With zero, or with a fixed alpha, the tolerance alone ends the iteration.
    pub truncation_share: T,
    /// Largest number of iterations of a step. The step fails if they are not enough.
    pub max_iterations: u32,
    /// Largest number of sweeps in one projection. The step fails if the violation is still too large after them.
    pub max_sweeps: u32,
    /// Adds the geometric stiffness of the constraints to the tangent.
    pub geometric_stiffness: bool,
    /// Evaluates phi by increments and stores q as a compensated pair.
    pub compensated: bool,
    /// Raises the penalty of a step where the weakest combination of constraints needs it.
    pub adaptive_penalty: bool,
}

/// Penalty alpha on the constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Penalty<T> {
    /// Proportional to the effective mass m_k of each row [-]: alpha = factor a' m_k in index-3 (a' = 4/dt^2 for the trapezoidal rule),
    /// alpha = factor m_k in index-1. The condition of the matrix then does not depend on the step.
    Scaled(T),
    /// The published, fixed alpha on every row [N/m in index-3, kg in index-1].
    Fixed(T),
}

impl<T: Real> Penalty<T> {
    /// Returns the factor of a scaled penalty, or one for a fixed alpha. A fixed alpha is raised only inside a projection that would
    /// otherwise miss its limit.
    pub(crate) fn factor(&self) -> T {
        match self {
            Self::Scaled(factor) => *factor,
            Self::Fixed(_) => T::ONE,
        }
    }
}

impl<T: Real> Options<T> {
    /// Returns the defaults of index-3.
    ///
    /// The penalty is 1e6 effective masses in double precision (1e2 to 1e8 work in regular motion), and 3e3 in single precision. The
    /// tolerance is 1e-10. Where effects act, the iteration also ends at 3e-7 of the first correction, except in scalars finer than double
    /// precision. At most 40 iterations are made: steps through singular positions take up to 20.
    #[must_use]
    pub fn index3() -> Self {
        let is_coarse = T::EPSILON >= T::from_f64(COARSE);
        let scale = T::from_f64(if is_coarse { PENALTY_OF_SINGLE } else { PENALTY });
        // scalars finer than double precision are used to solve the rule's equations to machine precision
        let is_fine = T::EPSILON < T::from_f64(f64::EPSILON);
        Self {
            integrator: Integrator::trapezoidal(),
            penalty: Penalty::Scaled(scale),
            tolerance: T::tolerance(TOLERANCE).max(T::EPSILON * T::from_f64(MIN_TOLERANCE)),
            truncation_share: if is_fine { T::ZERO } else { T::from_f64(TRUNCATION_SHARE) },
            max_iterations: MAX_ITERATIONS,
            max_sweeps: MAX_SWEEPS,
            geometric_stiffness: false,
            compensated: true,
            adaptive_penalty: true,
        }
    }

    /// Returns the defaults of index-1: penalty 1e6 effective masses, at most 4 iterations.
    ///
    /// At a singular position further iterations lead away from the solution. If the last correction is not small, eight times as many are
    /// made.
    #[must_use]
    pub fn index1() -> Self {
        Self {
            max_iterations: MAX_ITERATIONS_OF_INDEX1,
            max_sweeps: MAX_SWEEPS_OF_INDEX1,
            ..Self::index3()
        }
    }

    /// Checks the ranges of the options.
    ///
    /// # Errors
    /// [`OptionError`] names the option.
    pub fn validate(&self) -> Result<(), OptionError> {
        let (Penalty::Scaled(penalty) | Penalty::Fixed(penalty)) = self.penalty;
        for (name, value) in [("penalty", penalty), ("tolerance", self.tolerance)] {
            if !(value > T::ZERO && value.is_finite()) {
                return Err(OptionError::NotPositive(name));
            }
        }
        if !(self.truncation_share >= T::ZERO && self.truncation_share.is_finite()) {
            return Err(OptionError::Negative("truncation_share"));
        }
        if self.max_iterations == 0 {
            return Err(OptionError::NotPositive("max_iterations"));
        }
        Ok(())
    }
}
