//! The names a scene or the command line may choose from, and what they stand for.

use mbs_core::Real;
use mbs_core::integrator::Integrator;

/// Formulations that are built, by their names in scenes and on the command line.
pub const FORMULATIONS: [&str; 6] =
    ["auto", "index-1", "index-3", "classical", "state-space", "recursive"];
/// Integrators that are built.
pub const INTEGRATORS: [&str; 6] =
    ["trapezoidal", "newmark", "generalised-alpha", "hht", "rk4", "rk54"];
/// Precisions that are built.
pub const PRECISIONS: [&str; 2] = ["f32", "f64"];
/// Names of the scene format that are not built yet.
pub(crate) const NOT_BUILT: [&str; 4] = ["multi-index", "rk853", "radau5", "dd"];

/// A formulation that can run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Formulation {
    /// Index-3 augmented Lagrangian.
    Index3,
    /// Index-1 augmented Lagrangian.
    Index1,
    /// Index-3 classical Lagrangian.
    Classical,
    /// State space: independent coordinates by a null-space basis.
    StateSpace,
    /// Fully recursive, relative coordinates.
    Recursive,
}

impl Formulation {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Index1, Self::Index3, Self::Classical, Self::StateSpace, Self::Recursive];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Index3 => "index-3",
            Self::Index1 => "index-1",
            Self::Classical => "classical",
            Self::StateSpace => "state-space",
            Self::Recursive => "recursive",
        }
    }

    /// Does it run with this integrator?
    #[must_use]
    pub fn runs_with(self, integrator: IntegratorKind) -> bool {
        self == Self::Recursive || !integrator.is_explicit()
    }
}

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
}

impl IntegratorKind {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Trapezoidal,
        Self::Newmark,
        Self::GeneralisedAlpha,
        Self::Hht,
        Self::Rk4,
        Self::Rk54,
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
        }
    }

    /// Explicit Runge-Kutta?
    #[must_use]
    pub fn is_explicit(self) -> bool {
        matches!(self, Self::Rk4 | Self::Rk54)
    }

    /// Coefficients of an implicit one-step method; the trapezoidal rule's for the explicit ones.
    #[must_use]
    pub fn coefficients<T: Real>(self) -> Integrator<T> {
        match self {
            Self::Newmark => Integrator::newmark(T::from_f64(0.3025), T::from_f64(0.6)),
            Self::GeneralisedAlpha => Integrator::generalised_alpha(T::from_f64(0.8)),
            Self::Hht => Integrator::hht(T::from_f64(0.05)),
            Self::Trapezoidal | Self::Rk4 | Self::Rk54 => Integrator::trapezoidal(),
        }
    }
}

/// Number format of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// Single precision.
    F32,
    /// Double precision.
    F64,
}

impl Precision {
    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_offered_stands_for_something() {
        let names = Formulation::ALL.map(Formulation::name);
        assert!(FORMULATIONS[1..].iter().all(|name| names.contains(name)));
        assert_eq!(IntegratorKind::ALL.map(IntegratorKind::name), INTEGRATORS);
    }
}
