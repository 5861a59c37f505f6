//! Methods that are compared: formulation, integrator, step control and precision.

use mbs::{FormulationKind, IntegratorKind, Method, Precision};

/// Control of the length of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// Fixed steps: the setting is the step [s].
    Fixed,
    /// Control by an estimate of the local error; the setting is its tolerance.
    Error,
    /// Control by the energy invariant. The setting is the upper tolerance U; the lower tolerance L is a hundredth of it.
    Energy,
    /// Control by the integrator itself; the setting is its tolerance.
    Own,
}

/// Method of a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MethodCase {
    /// Formulation of the method.
    pub formulation: FormulationKind,
    /// Integrator of the method.
    pub integrator: IntegratorKind,
    /// Control of the length of the steps.
    pub control: Control,
    /// Precision of the numbers.
    pub precision: Precision,
}

/// Precisions of a comparison. Double-double is compared only on request.
pub(crate) const PRECISIONS: [Precision; 3] =
    [Precision::F64, Precision::F32, Precision::DoubleDouble];

/// Pairs of integrator and step control that a formulation allows.
fn ways(formulation: FormulationKind) -> Vec<(IntegratorKind, Control)> {
    use Control::{Energy, Error, Fixed, Own};
    use IntegratorKind::{Extrapolation, Radau5, Rk4, Rk54, Rk853, Trapezoidal};
    let row = formulation.row();
    let mut ways = vec![(Trapezoidal, Error)];
    if row.energy_rule {
        // the index of this formulation changes with the step: steps are not fixed, but controlled
        ways.push((Trapezoidal, Energy));
    } else {
        ways.insert(0, (Trapezoidal, Fixed));
    }
    if row.relative {
        ways.extend([(Rk4, Fixed), (Rk54, Own), (Rk853, Own), (Extrapolation, Own), (Radau5, Own)]);
    }
    ways
}

impl MethodCase {
    /// Lists all requested methods, sorted by precision. An empty list requests all formulations, or the usual precisions.
    pub fn all(formulations: &[FormulationKind], precisions: &[Precision]) -> Vec<Self> {
        let mut methods = Vec::new();
        for precision in PRECISIONS {
            let is_usual = precisions.is_empty() && precision != Precision::DoubleDouble;
            if !(is_usual || precisions.contains(&precision)) {
                continue;
            }
            for formulation in FormulationKind::listed() {
                if !(formulations.is_empty() || formulations.contains(&formulation)) {
                    continue;
                }
                let ways = ways(formulation).into_iter();
                methods.extend(ways.map(|(integrator, control)| Self {
                    formulation,
                    integrator,
                    control,
                    precision,
                }));
            }
        }
        methods
    }

    /// Returns the name of the method. The name leaves out usual settings, but not the precision.
    pub fn name(&self) -> String {
        let integrator = match self.integrator {
            IntegratorKind::Trapezoidal => String::new(),
            other => format!(" {}", other.name()),
        };
        let control = match self.control {
            Control::Error => ", error-controlled",
            Control::Energy => ", energy-controlled",
            Control::Fixed | Control::Own => "",
        };
        format!("{}{integrator}{control}, {}", self.formulation.name(), self.precision.name())
    }

    /// Word for the step control, in tables.
    pub(crate) fn control(&self) -> &'static str {
        match self.control {
            Control::Fixed => "fixed",
            Control::Error => "error",
            Control::Energy => "energy",
            Control::Own => "own",
        }
    }

    /// True if the settings of this method are step lengths.
    pub fn is_fixed(&self) -> bool {
        self.control == Control::Fixed
    }

    /// Returns the factor by which the work grows with the next setting: a step shorter by `ratio`, or a tolerance smaller by `ratio`.
    pub(crate) fn growth(&self, ratio: f64) -> f64 {
        ratio.powf(self.cost())
    }

    /// Exponent b of the CPU time, which is proportional to setting^-b.
    pub(crate) fn cost(&self) -> f64 {
        match (self.control, self.integrator) {
            (Control::Fixed, _) => 1.0,
            // the local error grows with the third power of the step; with the 5th in rk54, 8th in rk853, 10th in gbs, 4th in radau5
            (Control::Error | Control::Energy, _) => 1.0 / 3.0,
            (Control::Own, IntegratorKind::Extrapolation) => 0.1,
            (Control::Own, IntegratorKind::Rk853) => 0.125,
            (Control::Own, IntegratorKind::Radau5) => 0.25,
            (Control::Own, _) => 0.2,
        }
    }

    /// Order of the error in the mean step. For an integrator with its own step control it is the order of the tolerance.
    pub(crate) fn order(&self) -> f64 {
        match (self.control, self.integrator) {
            (Control::Fixed, IntegratorKind::Rk4) => 4.0,
            (Control::Fixed, IntegratorKind::Newmark) => 1.0,
            (Control::Own, _) => 1.0 / self.cost(),
            // the local error grows with the cube of the step, the global error with its square
            (Control::Fixed | Control::Error | Control::Energy, _) => 2.0,
        }
    }

    /// Returns the options of a run of this method. `interval` is the distance of the instants [s], and `step` the length of the first step,
    /// or of all [s].
    pub(crate) fn overrides(&self, setting: f64, step: f64, interval: f64) -> Method {
        let control = match self.control {
            Control::Fixed | Control::Own => "fixed",
            Control::Error => "error",
            Control::Energy => "energy",
        };
        let longest = if self.is_fixed() { step } else { interval };
        Method {
            formulation: Some(self.formulation.name().to_owned()),
            integrator: Some(self.integrator.name().to_owned()),
            precision: Some(self.precision.name().to_owned()),
            step: Some(step.min(longest)),
            step_max: Some(longest),
            step_control: Some(control.to_owned()),
            error_tolerance: (self.control == Control::Error).then_some(setting),
            energy_tolerance: (self.control == Control::Energy)
                .then_some([setting, setting / 100.0]),
            tolerance: (self.control == Control::Own).then_some(setting),
            ..Method::default()
        }
    }
}
