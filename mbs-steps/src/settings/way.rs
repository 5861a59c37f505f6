//! Checks of the resolved step, and a description of the method as text.

use super::length::{is_controlled, is_too_long};
use super::{ResolvedMethod, SettingsError};
use crate::choice::{IntegratorKind, StepRule};
use crate::record::MethodChoice;
use crate::settings::Method;
use mbs_core::scene::Scene;
use mbs_scene::format::significant;

impl ResolvedMethod {
    /// Checks that a requested step of fixed length is not longer than the run. Such a request is probably a mistake, because the run would
    /// make a single step of the length of the run.
    ///
    /// # Errors
    /// [`SettingsError::StepTooLong`] for a longer step.
    pub fn check_step<T>(&self, scene: &Scene<T>, overrides: &Method) -> Result<(), SettingsError> {
        let is_asked = overrides.step.is_some() || scene.solver.step.is_some();
        let (step, duration) = (self.step, self.duration);
        if is_asked && !is_controlled(self.integrator, self.rule) && is_too_long(step, duration) {
            return Err(SettingsError::StepTooLong { step, duration });
        }
        Ok(())
    }

    /// Formulation and integrator as text, with the length of a step or the tolerance.
    #[must_use]
    pub fn way(&self) -> String {
        let mut way = self.formulation.name().to_owned();
        if self.integrator != IntegratorKind::Trapezoidal {
            way = format!("{way} {}", self.integrator.name());
        }
        match (self.integrator.controls_its_step(), self.tolerance) {
            (true, Some(tolerance)) => {
                format!("{way} with a tolerance of {}", mbs_scene::format::few(tolerance))
            }
            (true, None) => format!("{way} with steps of its own"),
            _ if self.rule != StepRule::Fixed => format!("{way} with steps of controlled length"),
            _ => format!("{way} with steps of {} s", significant(self.step)),
        }
    }

    /// Returns the method that `auto` chose, with the reasons; `None` if a formulation was requested by name.
    #[must_use]
    pub fn chosen(&self) -> Option<MethodChoice> {
        let (formulation, ran) = (self.formulation.name().to_owned(), self.way());
        if let Some(choice) = &self.choice {
            let mut reasons = choice.reasons();
            let is_first =
                choice.fallbacks.is_empty() && choice.candidates.iter().any(|c| c.rank.is_some());
            if !is_first {
                reasons.insert(0, format!("what ran: {ran}"));
            }
            return Some(MethodChoice {
                formulation,
                ran,
                reasons,
                evidence: Some((**choice).clone()),
            });
        }
        (self.asked == "auto").then(|| MethodChoice {
            formulation,
            ran,
            reasons: vec![if self.integrator.is_of_first_order() {
                format!("integrator {} runs in relative coordinates", self.integrator.name())
            } else {
                "without a required error or a deadline auto means index-3: nothing is measured, and a scene gives the same numbers \
                 every time"
                    .to_owned()
            }],
            evidence: None,
        })
    }
}
