//! Accuracy of a run, estimated by a second run of the same motion.

use super::outputs::Outputs;

/// Estimate of the errors of a run's outputs.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ErrorEstimate {
    /// Sentence that says how the errors were estimated; absent without an estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub basis: Option<String>,
    /// Reason why no estimate could be made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub missing: Option<String>,
    /// Largest error of each component over the run, in the unit of the component.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outputs: Option<Outputs>,
    /// Largest error of an output relative to the range of that output [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest: Option<f64>,
    /// Output with the largest relative error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_output: Option<String>,
    /// CPU time of the estimate [s].
    pub cpu_seconds: f64,
    /// Largest rotation of a body in a step [rad].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_per_step: Option<f64>,
    /// Number of steps in a period of the stiffest force, which is the force with the shortest period.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_period: Option<f64>,
    /// Warnings about steps that are too long for the motion.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}
