//! Names and meanings of the integrators, step rules and precisions that a scene or the command line may choose.

use mbs_core::Real;
use mbs_core::integrator::Integrator;

/// Names of the available integrators.
pub const INTEGRATORS: [&str; 9] = IntegratorKind::NAMES;
/// Names of the available precisions.
pub const PRECISIONS: [&str; 3] = Precision::NAMES;
/// Names of the available rules of step control.
pub const STEP_RULES: [&str; 5] = StepRule::NAMES;

mbs_core::named! {
    /// Integrator of the equations of motion, with its fixed parameters.
    pub enum IntegratorKind {
        /// Trapezoidal rule, of order 2 and without numerical damping.
        Trapezoidal = "trapezoidal",
        /// Newmark's method with gamma = 0.6 and beta = (gamma + 1/2)^2 / 4 = 0.3025. It has numerical damping and is of first order.
        Newmark = "newmark",
        /// Generalised-alpha method with spectral radius 0.8 at infinity.
        GeneralisedAlpha = "generalised-alpha",
        /// HHT method (Hilber, Hughes, Taylor) with alpha = 0.05.
        Hht = "hht",
        /// Explicit Runge-Kutta method of order 4.
        Rk4 = "rk4",
        /// Explicit Runge-Kutta method of order 5, with an error estimate of order 4 for the step control.
        Rk54 = "rk54",
        /// Explicit Runge-Kutta method of order 8, with error estimates of orders 5 and 3 for the step control.
        Rk853 = "rk853",
        /// Extrapolation of the midpoint rule (Gragg, Bulirsch and Stoer), for reference solutions. The tolerance determines order and step
        /// length.
        Extrapolation = "gbs",
        /// Implicit Runge-Kutta method of order 5 (collocation at three Radau points) with step control, for stiff effects.
        Radau5 = "radau5",
    }
}

impl IntegratorKind {
    /// True if the integrator is an explicit method.
    #[must_use]
    pub fn is_explicit(self) -> bool {
        matches!(self, Self::Rk4 | Self::Rk54 | Self::Rk853 | Self::Extrapolation)
    }

    /// True for an integrator of systems of first order. Only relative coordinates give such a system.
    #[must_use]
    pub fn is_of_first_order(self) -> bool {
        self.is_explicit() || self.controls_its_step()
    }

    /// True if the integrator chooses its internal steps by the tolerance.
    #[must_use]
    pub fn controls_its_step(self) -> bool {
        matches!(self, Self::Rk54 | Self::Rk853 | Self::Extrapolation | Self::Radau5)
    }

    /// Coefficients of an integrator of the Newmark family. Other integrators return the coefficients of the trapezoidal rule.
    #[must_use]
    pub fn coefficients<T: Real>(self) -> Integrator<T> {
        match self {
            Self::Newmark => Integrator::newmark(ratio(121, 400), ratio(3, 5)),
            Self::GeneralisedAlpha => Integrator::generalised_alpha(ratio(4, 5)),
            Self::Hht => Integrator::hht(ratio(1, 20)),
            Self::Trapezoidal
            | Self::Rk4
            | Self::Rk54
            | Self::Rk853
            | Self::Extrapolation
            | Self::Radau5 => Integrator::trapezoidal(),
        }
    }
}

/// Quotient of two integers, computed in the scalar type `T`, so that it is correct to the machine precision of `T`.
fn ratio<T: Real>(over: u16, under: u16) -> T {
    T::from_f64(over.into()) / T::from_f64(under.into())
}

mbs_core::named! {
    /// Rule that chooses the length of the steps.
    pub enum StepRule {
        /// No control: all steps have the requested length.
        Fixed = "fixed",
        /// Control by the change of the energy invariant.
        Energy = "energy",
        /// Control by the change of the energy invariant as in publication 2: the step length changes only if that change crosses a limit.
        EnergyPrinted = "energy-printed",
        /// Control by an estimate of the local error.
        Error = "error",
        /// Control by both criteria: the shorter one of the two steps is used.
        Both = "both",
    }
}

impl StepRule {
    /// Returns the canonical name in [`STEP_RULES`]: `energy-published` is an alias of `energy-printed`.
    pub fn canonical(name: &str) -> &str {
        if name == "energy-published" { "energy-printed" } else { name }
    }

    /// True if the change of the energy invariant controls the step.
    #[must_use]
    pub fn has_energy(self) -> bool {
        matches!(self, Self::Energy | Self::EnergyPrinted | Self::Both)
    }

    /// True if the error estimate controls the step.
    #[must_use]
    pub fn has_error(self) -> bool {
        matches!(self, Self::Error | Self::Both)
    }

    /// Returns the rule that uses the given criteria.
    pub fn of(energy: bool, error: bool) -> Self {
        match (energy, error) {
            (false, false) => Self::Fixed,
            (true, false) => Self::Energy,
            (false, true) => Self::Error,
            (true, true) => Self::Both,
        }
    }
}

mbs_core::named! {
    /// Number format of a run.
    pub enum Precision {
        /// Single precision, about 7 digits.
        F32 = "f32",
        /// Double precision, about 16 digits.
        F64 = "f64",
        /// Double-double precision (pairs of doubles), about 32 digits.
        DoubleDouble = "dd",
    }
}
