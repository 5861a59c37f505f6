//! One run of an experiment: scene, formulation, and rule of the steps.

use crate::format::step;

/// Rule that chooses the steps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Rule {
    /// All steps have the same length.
    Fixed,
    /// Control by the change of the energy balance within a step, relative to the exchanged energy. A step whose change exceeds the
    /// tolerance is rejected. A step with less than a hundredth of the tolerance is followed by a longer one.
    Energy(f64),
    /// The energy rule as published in the report's second publication.
    Printed(f64),
    /// Control by the estimated error of a step, relative to the scene's length, with a tolerance.
    Error(f64),
    /// Control by the energy and by the error of a step, with the same tolerance.
    Both(f64),
}

/// One run of an experiment.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Case {
    /// The scene, by its file.
    pub(crate) scene: &'static str,
    /// `--formulation` of `mbs run`.
    pub(crate) formulation: &'static str,
    /// Rule that chooses the steps.
    pub(crate) rule: Rule,
    /// The step, or the first one [s].
    pub(crate) step: f64,
    /// The largest step [s].
    pub(crate) largest: f64,
    /// Simulated time of the run [s]; `None` for that of the scene.
    pub(crate) duration: Option<f64>,
    /// True if steps end at contacts and kinks; `None` for the default of `mbs run`.
    pub(crate) events: Option<bool>,
    /// Further arguments of `mbs run`.
    pub(crate) arguments: &'static [&'static str],
    /// Text that is appended to the scene.
    pub(crate) appended: &'static str,
}

impl Case {
    /// A run with a fixed step.
    pub(crate) fn fixed(scene: &'static str, formulation: &'static str, step: f64) -> Self {
        Self {
            scene,
            formulation,
            rule: Rule::Fixed,
            step,
            largest: step,
            duration: None,
            events: None,
            arguments: &[],
            appended: "",
        }
    }

    /// A run with controlled steps: the first and the largest step [s].
    pub(crate) fn variable(
        scene: &'static str,
        formulation: &'static str,
        rule: Rule,
        [first, largest]: [f64; 2],
    ) -> Self {
        Self { rule, largest, ..Self::fixed(scene, formulation, first) }
    }

    /// Returns the run with this simulated time [s]; `None` for that of the scene.
    pub(crate) fn lasting(self, duration: Option<f64>) -> Self {
        Self { duration, ..self }
    }

    /// Returns the run with the setting `events`, which is true if steps end at contacts and kinks.
    pub(crate) fn with_events(self, events: bool) -> Self {
        Self { events: Some(events), ..self }
    }

    /// The tolerance, if the steps are controlled.
    pub(crate) fn tolerance(&self) -> Option<f64> {
        match self.rule {
            Rule::Fixed => None,
            Rule::Energy(tolerance)
            | Rule::Printed(tolerance)
            | Rule::Error(tolerance)
            | Rule::Both(tolerance) => Some(tolerance),
        }
    }

    /// The rule as a word of `--step-control`.
    pub(crate) fn control(&self) -> &'static str {
        match self.rule {
            Rule::Fixed => "fixed",
            Rule::Energy(_) => "energy",
            Rule::Printed(_) => "energy-printed",
            Rule::Error(_) => "error",
            Rule::Both(_) => "both",
        }
    }

    /// The rule in words, for tables.
    pub(crate) fn rule(&self) -> &'static str {
        if let Rule::Printed(_) = self.rule { "energy as printed" } else { self.control() }
    }

    /// Returns the name of the run: formulation, rule, and step or tolerance.
    pub(crate) fn name(&self) -> String {
        let number = match self.tolerance() {
            None => format!("{} s", size(self.step)),
            Some(tolerance) => size(tolerance),
        };
        let events = match self.events {
            None => "",
            Some(true) => ", events on",
            Some(false) => ", events off",
        };
        format!("{}, {} {number}{events}", self.formulation, self.rule())
    }

    /// The arguments of `mbs run`, without the scene.
    pub(crate) fn arguments(&self) -> Vec<String> {
        let mut words = vec!["--formulation".to_owned(), self.formulation.to_owned()];
        let mut add = |name: &str, value: String| words.extend([name.to_owned(), value]);
        add("--step", step(self.step));
        if self.rule != Rule::Fixed {
            add("--step-control", self.control().to_owned());
            add("--step-max", step(self.largest));
        }
        if let Rule::Energy(upper) | Rule::Printed(upper) | Rule::Both(upper) = self.rule {
            add("--energy-tolerance", format!("{},{}", size(upper), size(upper / 100.0)));
        }
        if let Rule::Error(tolerance) | Rule::Both(tolerance) = self.rule {
            add("--error-tolerance", size(tolerance));
        }
        if let Some(duration) = self.duration {
            add("--duration", duration.to_string());
        }
        if let Some(events) = self.events {
            add("--events", if events { "on" } else { "off" }.to_owned());
        }
        words.extend(self.arguments.iter().map(|&word| word.to_owned()));
        words
    }
}

/// Text of a step or a tolerance, with three digits at most.
pub(crate) fn size(x: f64) -> String {
    let text = format!("{x:.2e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = digits.trim_end_matches('0').trim_end_matches('.');
    format!("{digits}e{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fixed_step_is_run_as_ever() {
        let case = Case::fixed("andrews", "index-1", 5e-4);
        assert_eq!(case.arguments().join(" "), "--formulation index-1 --step 5e-4");
        assert_eq!(case.name(), "index-1, fixed 5e-4 s");
        assert_eq!(case.tolerance(), None);
    }

    #[test]
    fn a_rule_brings_its_tolerances() {
        let steps = [1e-3, 1e-2];
        let energy = Case::variable("andrews", "multi-index", Rule::Energy(1e-6), steps);
        assert_eq!(
            energy.arguments().join(" "),
            "--formulation multi-index --step 1e-3 --step-control energy --step-max 1e-2 --energy-tolerance 1e-6,1e-8"
        );
        let printed = Case { rule: Rule::Printed(1e-6), ..energy.clone() };
        assert_eq!(printed.arguments()[5], "energy-printed");
        assert_eq!(printed.name(), "multi-index, energy as printed 1e-6");
        let both = Case::variable("andrews", "index-3", Rule::Both(1e-5 / 10_f64.sqrt()), steps);
        let both = both.lasting(Some(3.0)).with_events(false);
        assert!(both.arguments().join(" ").ends_with(
            "--energy-tolerance 3.16e-6,3.16e-8 --error-tolerance 3.16e-6 --duration 3 --events off"
        ));
        assert_eq!(both.name(), "index-3, both 3.16e-6, events off");
    }
}
