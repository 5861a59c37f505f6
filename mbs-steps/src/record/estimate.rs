//! Accuracy of a run, by a second run of its motion.

use super::outputs::Outputs;

/// An estimate of the errors of a run's outputs.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ErrorEstimate {
    /// Basis of the estimate; absent where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis: Option<String>,
    /// Reason why there is no estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<String>,
    /// The largest error of each component over the run, in its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outputs: Option<Outputs>,
    /// The largest of them, each relative to the range of its output [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest: Option<f64>,
    /// The output that has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_output: Option<String>,
    /// CPU time of the look [s].
    pub cpu_seconds: f64,
    /// The largest turn of a body in a step [rad].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_per_step: Option<f64>,
    /// Steps in a period of the stiffest force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_period: Option<f64>,
    /// Warnings on what makes the steps too long for the motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}
