//! What the caller chooses. Public fields; start from [`Options::index3`] or [`Options::index1`].

use mbs_core::Real;
use mbs_core::integrator::Integrator;
use mbs_core::step::OptionError;

/// Choices for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<T> {
    /// Time integrator.
    pub integrator: Integrator<T>,
    /// Penalty on the constraints.
    pub penalty: Penalty<T>,
    /// A correction below this times what accelerations move in a step is small; in index-1, times the accelerations [-].
    pub tolerance: T,
    /// Where effects act, what a correction of index-3 leaves, taken to be a tenth of it at least, is small too where it is below this
    /// share of the step's first one, which is three times what the trapezoidal rule errs by in the step; zero, and with a fixed alpha or
    /// printed projections: the tolerance alone [-].
    pub share: T,
    /// Iterations allowed in one step.
    pub max_iterations: u32,
    /// Sweeps of a projection after which its level must be reached.
    pub max_sweeps: u32,
    /// Start value of the multipliers.
    pub multipliers: Multipliers,
    /// How velocities and accelerations are projected.
    pub projection: Projection,
    /// Put the geometric stiffness of the constraints into the tangent.
    pub geometric_stiffness: bool,
    /// Evaluate phi by increments and carry q as a compensated pair.
    pub compensated: bool,
    /// Choose the penalty anew at each step from the contraction that the projections showed.
    pub adaptive_penalty: bool,
}

/// The penalty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Penalty<T> {
    /// In proportion to the effective mass of each row: alpha = factor a' m_k in index-3 (a' = 4/dt^2 for the trapezoidal
    /// rule), alpha = factor m_k in index-1 [-]. Conditioning then does not depend on the step.
    Scaled(T),
    /// The printed, fixed alpha on every row [N/m in index-3, kg in index-1].
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

/// Start value of the multipliers of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Multipliers {
    /// 2 lambda_n - lambda_(n-1) [P3 (3)], filtered by s J T^-1 J^T so that no component grows that the constraints cannot feed.
    Filtered,
    /// 2 lambda_n - lambda_(n-1) [P3 (3)].
    Extrapolated,
    /// Zero [P1 (16)], publication 2.
    FromZero,
}

/// How velocities and accelerations are projected on their constraints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Projection {
    /// Mass-orthogonal, solved for the correction from the residual, swept until the level is reached.
    Correction,
    /// The printed iteration [P1 (13), (19)]: (M + J^T alpha J) v <- M v - J^T alpha phi_t at the final q, factored anew, a
    /// fixed number of sweeps, no level. Index-3 only.
    Printed {
        /// Sweeps.
        sweeps: u32,
    },
    /// The printed one with the already factored tangent [P3 (11)-(12)]: one sweep, weight M + C + K. Index-3 only.
    PrintedTangent,
}

impl<T: Real> Options<T> {
    /// Defaults of index-3.
    ///
    /// Penalty 1e6 effective masses in double precision (methods: 1e2 to 1e8 work in regular motion), the square root of
    /// 1/eps in others; tolerance 1e-10, or where effects act, up to double precision, 3e-7 of the first correction; at most 40 iterations: passages of
    /// singular positions take up to 20.
    #[must_use]
    pub fn index3() -> Self {
        let scale =
            if T::EPSILON < T::from_f64(1e-12) { T::from_f64(1e6) } else { T::from_f64(3e3) };
        Self {
            integrator: Integrator::trapezoidal(),
            penalty: Penalty::Scaled(scale),
            tolerance: T::tolerance(1e-10).max(T::EPSILON * T::from_f64(64.0)),
            // in finer scalars than double what is wanted is the rule's own solution, to rounding
            share: if T::EPSILON < T::from_f64(f64::EPSILON) { T::ZERO } else { T::from_f64(3e-7) },
            max_iterations: 40,
            max_sweeps: 12,
            multipliers: Multipliers::Filtered,
            projection: Projection::Correction,
            geometric_stiffness: false,
            compensated: true,
            adaptive_penalty: true,
        }
    }

    /// Defaults of index-1: penalty 1e6 effective masses, at most 4 iterations, since iterating on at a singular position
    /// leads away from the solution there; eight times as many where what is left is not small.
    #[must_use]
    pub fn index1() -> Self {
        Self { max_iterations: 4, max_sweeps: 20, ..Self::index3() }
    }

    /// The form of publications 1 and 2: fixed alpha, multipliers from zero, printed projections, plain arithmetic.
    #[must_use]
    pub fn printed(alpha: T) -> Self {
        Self {
            penalty: Penalty::Fixed(alpha),
            multipliers: Multipliers::FromZero,
            projection: Projection::Printed { sweeps: 1 },
            compensated: false,
            adaptive_penalty: false,
            max_iterations: 20,
            share: T::ZERO,
            ..Self::index3()
        }
    }

    /// Checks the ranges.
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
        if !(self.share >= T::ZERO && self.share.is_finite()) {
            return Err(OptionError::Negative("share"));
        }
        if self.max_iterations == 0 {
            return Err(OptionError::NotPositive("max_iterations"));
        }
        Ok(())
    }
}
