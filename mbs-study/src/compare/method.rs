//! The methods that are compared: formulation, integrator, what chooses the steps, precision.

use mbs::{FormulationKind, IntegratorKind, Method, Precision};

/// Control of the length of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// No control: the setting is the step.
    Fixed,
    /// An estimate of the local error; the setting is its tolerance.
    Error,
    /// Control by the energy invariant; the setting is U, and L a hundredth of it.
    Energy,
    /// Control by the integrator itself; the setting is its tolerance.
    Own,
}

/// Method that is compared.
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

/// Precisions that are compared; the last one only where it is asked for.
pub(crate) const PRECISIONS: [Precision; 3] =
    [Precision::F64, Precision::F32, Precision::DoubleDouble];

/// Ways to step a formulation.
fn ways(formulation: FormulationKind) -> Vec<(IntegratorKind, Control)> {
    use Control::{Energy, Error, Fixed, Own};
    use IntegratorKind::{Extrapolation, Radau5, Rk4, Rk54, Rk853, Trapezoidal};
    let row = formulation.row();
    let mut ways = vec![(Trapezoidal, Error)];
    if row.energy_rule {
        // its index changes with the step
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
    /// All that are wanted, by precision; none given means all of that kind.
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

    /// Returns the name of the method: what is usual is left out, the precision is not.
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

    /// Word for its control, in tables.
    pub(crate) fn control(&self) -> &'static str {
        match self.control {
            Control::Fixed => "fixed",
            Control::Error => "error",
            Control::Energy => "energy",
            Control::Own => "own",
        }
    }

    /// Are its settings steps?
    pub fn is_fixed(&self) -> bool {
        self.control == Control::Fixed
    }

    /// Returns the factor by which the next setting is more work: for a step that is shorter by `ratio`, or a tolerance smaller by that.
    pub(crate) fn growth(&self, ratio: f64) -> f64 {
        ratio.powf(self.cost())
    }

    /// Exponent of the CPU time in the setting, its sign changed.
    pub(crate) fn cost(&self) -> f64 {
        match (self.control, self.integrator) {
            (Control::Fixed, _) => 1.0,
            // the local error goes with the cube of the step. In rk54 it goes with the fifth power, in rk853 with the eighth,
            // in gbs about with the tenth, in radau5 with the fourth
            (Control::Error | Control::Energy, _) => 1.0 / 3.0,
            (Control::Own, IntegratorKind::Extrapolation) => 0.1,
            (Control::Own, IntegratorKind::Rk853) => 0.125,
            (Control::Own, IntegratorKind::Radau5) => 0.25,
            (Control::Own, _) => 0.2,
        }
    }

    /// Order of the error in the mean step; what the tolerance stands for where the integrator controls its own steps.
    pub(crate) fn order(&self) -> f64 {
        match (self.control, self.integrator) {
            (Control::Fixed, IntegratorKind::Rk4) => 4.0,
            (Control::Fixed, IntegratorKind::Newmark) => 1.0,
            (Control::Own, _) => 1.0 / self.cost(),
            // the local error goes with the cube of the step, the global one with its square
            (Control::Fixed | Control::Error | Control::Energy, _) => 2.0,
        }
    }

    /// Returns the options of a run of this method, between instants `interval` apart, and first (or all) steps of `step` [s].
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
