//! Checks of step lengths against the duration of a run.

use crate::choice::{IntegratorKind, StepRule};
use mbs_scene::format::significant;

/// Relative difference up to which two lengths of time count as equal [-], because they may be written with few digits. Chosen, not tuned.
pub const SAME_LENGTH: f64 = 1e-9;

/// Largest number of steps of a run [-]. At one microsecond per step they take eleven days.
pub(super) const MOST_STEPS: f64 = 1e12;

/// True if the length of the steps is controlled, by the integrator or by a step rule.
pub(super) fn is_controlled(integrator: IntegratorKind, rule: StepRule) -> bool {
    integrator.controls_its_step() || rule != StepRule::Fixed
}

/// True if the step [s] is longer than the duration of the run [s].
pub fn is_too_long(step: f64, duration: f64) -> bool {
    step > duration * (1.0 + SAME_LENGTH)
}

/// Returns the message for a step [s] that is longer than the run.
pub fn too_long(step: f64, duration: f64) -> String {
    format!(
        "the step of {} s is longer than the run of {} s",
        significant(step),
        significant(duration)
    )
}
