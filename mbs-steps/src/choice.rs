//! The names of integrators, step rules and precisions that a scene or the command line may choose from, and what they stand for.

use mbs_core::Real;
use mbs_core::integrator::Integrator;

/// Integrators that are built.
pub const INTEGRATORS: [&str; 9] = IntegratorKind::NAMES;
/// Precisions that are built.
pub const PRECISIONS: [&str; 3] = Precision::NAMES;
/// Controls of the step size.
pub const STEP_RULES: [&str; 5] = StepRule::NAMES;

mbs_core::named! {
    /// An integrator that can run, with the parameters it is given.
    pub enum IntegratorKind {
        /// Trapezoidal rule.
        Trapezoidal = "trapezoidal",
        /// Newmark's method with gamma = 0.6, beta = (gamma + 1/2)^2 / 4 = 0.3025: numerical damping, first order.
        Newmark = "newmark",
        /// Generalised-alpha with spectral radius 0.8 at infinity.
        GeneralisedAlpha = "generalised-alpha",
        /// HHT with alpha = 0.05.
        Hht = "hht",
        /// Explicit Runge-Kutta of order 4.
        Rk4 = "rk4",
        /// Explicit Runge-Kutta of order 5 with an estimate of order 4, which controls the step.
        Rk54 = "rk54",
        /// Explicit Runge-Kutta of order 8 with estimates of orders 5 and 3, which control the step.
        Rk853 = "rk853",
        /// Extrapolation of the midpoint rule (Gragg, Bulirsch and Stoer): of as high an order as the tolerance is worth, which controls
        /// the step. For reference runs.
        Extrapolation = "gbs",
        /// Implicit Runge-Kutta of order 5, collocation at three Radau points, which controls the step. For stiff effects.
        Radau5 = "radau5",
    }
}

impl IntegratorKind {
    /// Is the integrator explicit?
    #[must_use]
    pub fn is_explicit(self) -> bool {
        matches!(self, Self::Rk4 | Self::Rk54 | Self::Rk853 | Self::Extrapolation)
    }

    /// Is it one for systems of first order, which relative coordinates alone make?
    #[must_use]
    pub fn is_of_first_order(self) -> bool {
        self.is_explicit() || self.controls_its_step()
    }

    /// Does it control its own step by the tolerance?
    #[must_use]
    pub fn controls_its_step(self) -> bool {
        matches!(self, Self::Rk54 | Self::Rk853 | Self::Extrapolation | Self::Radau5)
    }

    /// Coefficients of a method of the Newmark family; the trapezoidal rule's for the others.
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

/// A quotient of whole numbers, exact to rounding in every precision.
fn ratio<T: Real>(over: u16, under: u16) -> T {
    T::from_f64(over.into()) / T::from_f64(under.into())
}

mbs_core::named! {
    /// Rule that chooses the length of the steps.
    pub enum StepRule {
        /// Nothing: all steps are as long as asked for.
        Fixed = "fixed",
        /// The change of the energy invariant.
        Energy = "energy",
        /// Change of the energy invariant, as publication 2 prints it: the step changes only where the change crosses a limit.
        EnergyPrinted = "energy-printed",
        /// An estimate of the local error.
        Error = "error",
        /// The shorter of both.
        Both = "both",
    }
}

impl StepRule {
    /// The name in [`STEP_RULES`] of a name that a scene or the command line gives: `energy-published` is `energy-printed`.
    pub fn canonical(name: &str) -> &str {
        if name == "energy-published" { "energy-printed" } else { name }
    }

    /// Does the energy invariant steer?
    #[must_use]
    pub fn has_energy(self) -> bool {
        matches!(self, Self::Energy | Self::EnergyPrinted | Self::Both)
    }

    /// Does the error estimate steer?
    #[must_use]
    pub fn has_error(self) -> bool {
        matches!(self, Self::Error | Self::Both)
    }

    /// The rule of those that are given.
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
        /// Single precision.
        F32 = "f32",
        /// Double precision.
        F64 = "f64",
        /// Pairs of doubles, about 32 digits.
        DoubleDouble = "dd",
    }
}
