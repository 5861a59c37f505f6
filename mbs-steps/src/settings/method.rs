//! A method as code writes it.

use super::Method;
use crate::choice::{IntegratorKind, Precision, StepRule};
use crate::methods::FormulationKind;

impl Method {
    /// Method by this formulation; all else is the mechanism's, or its default.
    ///
    /// ```
    /// use mbs::{FormulationKind, IntegratorKind, Method};
    /// let method = Method::new(FormulationKind::Recursive).integrator(IntegratorKind::Rk4).step(1e-3);
    /// ```
    #[must_use]
    pub fn new(formulation: FormulationKind) -> Self {
        Self { formulation: Some(formulation.name().to_owned()), ..Self::default() }
    }

    /// Sets the integrator of the method. Default: the trapezoidal rule. Those of first order (`rk4`, `rk54`, `rk853`, `gbs`, `radau5`) are of
    /// relative coordinates: where no formulation is named they take `recursive`.
    #[must_use]
    pub fn integrator(self, integrator: IntegratorKind) -> Self {
        Self { integrator: Some(integrator.name().to_owned()), ..self }
    }

    /// Sets the precision of the method. Default: `f64`.
    #[must_use]
    pub fn precision(self, precision: Precision) -> Self {
        Self { precision: Some(precision.name().to_owned()), ..self }
    }

    /// Steps of this length [s]; the first one where lengths are controlled. Default: 1 ms.
    #[must_use]
    pub fn step(self, dt: f64) -> Self {
        Self { step: Some(dt), ..self }
    }

    /// Tolerance of the iterations, relative to the displacement per step; of an integrator that controls its steps, the error of each.
    /// Default: 1e-10, of such an integrator 1e-8.
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        Self { tolerance: Some(tolerance), ..self }
    }

    /// Sets the rule that chooses the length of the steps. Default: none, all are as long as asked for. Lengths only shrink unless
    /// [`step_max`](Self::step_max) lets them grow.
    ///
    /// ```
    /// use mbs::{Method, StepRule};
    /// let method = Method::default().control(StepRule::Error).error_tolerance(1e-7).step(1e-4).step_max(1e-2);
    /// ```
    #[must_use]
    pub fn control(self, control: StepRule) -> Self {
        Self { step_control: Some(control.name().to_owned()), ..self }
    }

    /// Largest step of a controlled length [s]. Default: the step.
    #[must_use]
    pub fn step_max(self, dt: f64) -> Self {
        Self { step_max: Some(dt), ..self }
    }

    /// Error of a step by its estimate, relative to the scene's length, where [`StepRule::Error`] chooses the length. Default: 1e-6.
    #[must_use]
    pub fn error_tolerance(self, error: f64) -> Self {
        Self { error_tolerance: Some(error), ..self }
    }

    /// Threads that share the work of a step: the results are the same to the bit. Default: 1.
    #[must_use]
    pub fn threads(self, n: usize) -> Self {
        Self { threads: Some(n), ..self }
    }

    /// A fixed penalty [N/m in index-3, kg in index-1]. Default: in proportion to the effective mass.
    #[must_use]
    pub fn penalty(self, alpha: f64) -> Self {
        Self { penalty: Some(alpha), ..self }
    }
}
