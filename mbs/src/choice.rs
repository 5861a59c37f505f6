//! The names of integrators, step rules and precisions that a scene or the command line may choose from, and what they stand for.

use mbs_core::Real;
use mbs_core::integrator::Integrator;

/// Integrators that are built.
pub const INTEGRATORS: [&str; 9] =
    ["trapezoidal", "newmark", "generalised-alpha", "hht", "rk4", "rk54", "rk853", "gbs", "radau5"];
/// Precisions that are built.
pub const PRECISIONS: [&str; 3] = ["f32", "f64", "dd"];
/// Controls of the step size.
pub const STEP_RULES: [&str; 5] = ["fixed", "energy", "energy-printed", "error", "both"];

/// An integrator that can run, with the parameters it is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntegratorKind {
    /// Trapezoidal rule.
    Trapezoidal,
    /// Newmark's method with gamma = 0.6, beta = (gamma + 1/2)^2 / 4 = 0.3025: numerical damping, first order.
    Newmark,
    /// Generalised-alpha with spectral radius 0.8 at infinity.
    GeneralisedAlpha,
    /// HHT with alpha = 0.05.
    Hht,
    /// Explicit Runge-Kutta of order 4.
    Rk4,
    /// Explicit Runge-Kutta of order 5 with an estimate of order 4, which controls the step.
    Rk54,
    /// Explicit Runge-Kutta of order 8 with estimates of orders 5 and 3, which control the step.
    Rk853,
    /// Extrapolation of the midpoint rule (Gragg, Bulirsch and Stoer): of as high an order as the tolerance is worth, which controls
    /// the step. For reference runs.
    Extrapolation,
    /// Implicit Runge-Kutta of order 5, collocation at three Radau points, which controls the step. For stiff effects.
    Radau5,
}

impl IntegratorKind {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Trapezoidal,
        Self::Newmark,
        Self::GeneralisedAlpha,
        Self::Hht,
        Self::Rk4,
        Self::Rk54,
        Self::Rk853,
        Self::Extrapolation,
        Self::Radau5,
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Trapezoidal => "trapezoidal",
            Self::Newmark => "newmark",
            Self::GeneralisedAlpha => "generalised-alpha",
            Self::Hht => "hht",
            Self::Rk4 => "rk4",
            Self::Rk54 => "rk54",
            Self::Rk853 => "rk853",
            Self::Extrapolation => "gbs",
            Self::Radau5 => "radau5",
        }
    }

    /// Explicit?
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

/// What chooses the length of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepRule {
    /// Nothing: all steps are as long as asked for.
    Fixed,
    /// The change of the energy invariant.
    Energy,
    /// The same as publication 2 prints it: the step changes only where the change crosses a limit.
    EnergyPrinted,
    /// An estimate of the local error.
    Error,
    /// The shorter of both.
    Both,
}

impl StepRule {
    /// All of them, in the order of [`STEP_RULES`].
    pub const ALL: [Self; 5] =
        [Self::Fixed, Self::Energy, Self::EnergyPrinted, Self::Error, Self::Both];

    /// The name in [`STEP_RULES`] of a name that a scene or the command line gives: `energy-published` is `energy-printed`.
    pub(crate) fn canonical(name: &str) -> &str {
        if name == "energy-published" { "energy-printed" } else { name }
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Energy => "energy",
            Self::EnergyPrinted => "energy-printed",
            Self::Error => "error",
            Self::Both => "both",
        }
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
    pub(crate) fn of(energy: bool, error: bool) -> Self {
        match (energy, error) {
            (false, false) => Self::Fixed,
            (true, false) => Self::Energy,
            (false, true) => Self::Error,
            (true, true) => Self::Both,
        }
    }
}

/// Number format of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
    /// Pairs of doubles, about 32 digits.
    DoubleDouble,
}

impl Precision {
    /// All, in the order of their names.
    pub const ALL: [Self; 3] = [Self::F32, Self::F64, Self::DoubleDouble];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
            Self::DoubleDouble => "dd",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_offered_stands_for_something() {
        assert_eq!(StepRule::ALL.map(StepRule::name), STEP_RULES);
        assert_eq!(Precision::ALL.map(Precision::name), PRECISIONS);
        assert_eq!(IntegratorKind::ALL.map(IntegratorKind::name), INTEGRATORS);
    }
}
