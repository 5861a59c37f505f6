//! Options that the caller chooses. Public fields; start from [`Options::index3`] or [`Options::index1`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Penalty c in double precision and finer [effective masses]. A sweep leaves 1e-6 of a violation, and 10 of 16 digits remain beside it;
/// 1e2 to 1e8 work in regular motion.
const PENALTY: f64 = 1e6;
/// Penalty c in coarser scalars [effective masses]: the square root of 1/EPSILON in f32, so that digits are shared between mass and penalty.
const PENALTY_OF_SINGLE: f64 = 3e3;
/// EPSILON from which a scalar is coarser in this sense [-]: between that of f64 and that of f32.
const COARSE: f64 = 1e-12;
/// Tolerance of the iterations [displacement by accelerations in a step]: below it a correction is at the rounding of forces in most scenes.
const TOLERANCE: f64 = 1e-10;
/// The least tolerance [EPSILON]: six binary digits are left to rounding.
const MIN_TOLERANCE: f64 = 64.0;
/// Share of the first correction that may be left where effects act [-]. At 1e-6 the energy error of a vehicle that steers at 30 m/s grows to the
/// double, at 3e-7 by a seventh.
const TRUNCATION_SHARE: f64 = 3e-7;
/// Iterations of index-3 [-]: passages of singular positions take up to 20.
const MAX_ITERATIONS: u32 = 40;
/// Iterations of index-1 [-]: iterating on at a singular position leads away from the solution there.
const MAX_ITERATIONS_OF_INDEX1: u32 = 4;
/// Sweeps of a projection in index-3 [-]: at the slowest contraction that raises no penalty, a tenth, twelve digits.
const MAX_SWEEPS: u32 = 12;
/// Sweeps of a projection in index-1 [-]: those of positions begin further off.
const MAX_SWEEPS_OF_INDEX1: u32 = 20;

/// Choices for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator of the steps.
    pub integrator: Integrator<T>,
    /// Penalty on the constraints.
    pub penalty: Penalty<T>,
    /// Tolerance of the iterations, relative to the displacement by accelerations in a step; in index-1, to the accelerations [-].
    pub tolerance: T,
    /// Share of the first correction of a step below which the iteration of index-3 also ends where effects act [-]. What a correction
    /// leaves is compared with it, and counts as a tenth of the correction at least. The first correction is three times the error of the
    /// trapezoidal rule in the step. Zero, and with a fixed alpha: the tolerance alone.
    pub truncation_share: T,
    /// Iterations allowed in one step.
    pub max_iterations: u32,
    /// Sweeps of a projection after which its level must be reached.
    pub max_sweeps: u32,
    /// Put the geometric stiffness of the constraints into the tangent.
    pub geometric_stiffness: bool,
    /// Evaluate phi by increments and carry q as a compensated pair.
    pub compensated: bool,
    /// Raise the penalty of a step where the weakest combination of constraints asks for it.
    pub adaptive_penalty: bool,
}

/// Penalty alpha on the constraints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Penalty<T> {
    /// In proportion to the effective mass of each row: alpha = factor a' m_k in index-3 (a' = 4/dt^2 for the trapezoidal
    /// rule), alpha = factor m_k in index-1 [-]. Conditioning then does not depend on the step.
    Scaled(T),
    /// The published, fixed alpha on every row [N/m in index-3, kg in index-1].
    Fixed(T),
}

impl<T: Real> Penalty<T> {
    /// The factor of a scaled penalty; one for a fixed alpha, which is raised only inside a projection that would not reach its
    /// level otherwise.
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
    /// Penalty 1e6 effective masses in double precision (methods: 1e2 to 1e8 work in regular motion), the square root of 1/eps in others.
    /// Tolerance 1e-10, or where effects act, up to double precision, 3e-7 of the first correction. At most 40 iterations: passages of
    /// singular positions take up to 20.
    #[must_use]
    pub fn index3() -> Self {
        let is_coarse = T::EPSILON >= T::from_f64(COARSE);
        let scale = T::from_f64(if is_coarse { PENALTY_OF_SINGLE } else { PENALTY });
        // in finer scalars than double the rule's own solution is asked for, to rounding
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

    /// Returns the defaults of index-1: penalty 1e6 effective masses, at most 4 iterations. To iterate on at a singular position leads away from
    /// the solution there. Eight times as many iterations are made where what is left is not small.
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
