//! Summary of a run as JSON, with the keys of the scene format.

use super::choice::PilotReport;
use super::estimate::ErrorEstimate;
use super::outputs::Outputs;
use super::realtime::RealtimeSummary;
use super::series::ControlSummary;
use super::statistics::ChannelSummary;

/// Summary of a run, written as one JSON object. Values that are not finite are written as `null`.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct RunSummary {
    /// Name of the scene.
    pub scene: String,
    /// Formulation as requested; it may be `auto`.
    pub formulation: String,
    /// Integrator that the run used.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub integrator: String,
    /// Precision of the run: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Method that the run used, and counts of its steps.
    pub method_used: MethodUsed,
    /// Dimension of the scene, 2 or 3.
    pub dimension: usize,
    /// Number of coordinates of the formulation that ran.
    pub coordinates: usize,
    /// Number of constraint rows of the formulation that ran.
    pub constraints: usize,
    /// Rank of the constraint Jacobian at the start.
    pub constraint_rank: usize,
    /// Degrees of freedom: coordinates minus rank.
    pub dof: usize,
    /// Step that was requested [s].
    pub step: f64,
    /// Number of completed steps.
    pub steps: u64,
    /// True if the run reached its whole duration.
    pub completed: bool,
    /// Reason why the run stopped early; `null` if it completed.
    pub error: Option<RunError>,
    /// Time that the run reached [s].
    pub end_time: f64,
    /// CPU time of all threads from the first step to the last [s]. For a paced run it is the clock time of its periods.
    pub cpu_seconds: f64,
    /// Simulated time divided by the computation time [-].
    pub real_time_factor: f64,
    /// Longest computation time of a step [s].
    pub worst_step_seconds: f64,
    /// Newton iterations, summed over all steps.
    pub iterations: u64,
    /// Factorisations, summed over all steps.
    pub factorizations: u64,
    /// Errors of the energy invariant over the run.
    pub energy: EnergySummary,
    /// Largest constraint violation over the run.
    pub violation: ViolationSummary,
    /// Summary of the step control; absent for fixed steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlSummary>,
    /// Timing report of a paced run; absent if the run was not paced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub realtime: Option<RealtimeSummary>,
    /// Values of the channels at `end_time`.
    pub outputs: Outputs,
    /// Statistics of each channel over all steps.
    pub channels: Vec<ChannelSummary>,
    /// Outputs as texts of 32 digits, for a run in double-double precision. Most JSON readers keep at most 17 digits of a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<Outputs<String>>,
    /// Estimated accuracy of the outputs; absent without an estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimate: Option<ErrorEstimate>,
    /// Method that `auto` chose, with the reasons.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<MethodChoice>,
    /// Joints whose reaction is not unique. The record has the reaction of smallest norm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_unique: Vec<String>,
    /// Contacts of bumpers, limits and tires that began or ended, in order of time.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<Contact>,
    /// Number of contacts that the list `contacts` omits.
    #[serde(skip_serializing_if = "is_zero")]
    pub contacts_left_out: u64,
}

/// Method that the run used, and counts of its steps.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct MethodUsed {
    /// Formulation of the method that ran.
    pub formulation: String,
    /// Integrator of the method that ran.
    pub integrator: String,
    /// Number of completed steps.
    pub steps: u64,
    /// Shortest step [s]; absent if the integrator makes internal steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_step: Option<f64>,
    /// Longest step [s]; absent if the integrator makes internal steps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_step: Option<f64>,
    /// Mean step: simulated time divided by the number of steps [s].
    pub mean_step: f64,
}

/// Begin or end of a contact.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Contact {
    /// Time of the event, interpolated within the step [s].
    pub time: f64,
    /// Name of the effect.
    pub effect: String,
    /// End of a limit, `lower` or `upper`; absent for other effects.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<&'static str>,
    /// Kind of event: `made` or `broken`.
    pub event: &'static str,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "what serde asks for")]
fn is_zero(n: &u64) -> bool {
    *n == 0
}

/// Reason why a run stopped early.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct RunError {
    /// Error code for programs, a constant word such as `not-converged`.
    pub code: String,
    /// Message of the error, one sentence.
    pub message: String,
    /// Time that the run reached [s].
    pub time: f64,
    /// Name of the joint concerned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Name of the body concerned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Hint for the user: what to do about the error.
    pub hint: String,
}

/// Energy invariant Pi = T + V - W [J]. T and V are the kinetic and potential energy, and W is the work of non-conservative forces and
/// guides.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct EnergySummary {
    /// Pi at the start [J].
    pub initial: f64,
    /// Largest |Pi(t) - Pi(0)| over all steps [J].
    pub max_error: f64,
    /// Value of |Pi - Pi(0)| at the end [J].
    pub final_error: f64,
    /// Exchanged energy: largest kinetic energy plus the sum of absolute work [J]. Energy errors are compared with it.
    pub turned_over: f64,
    /// Root mean square of the change of Pi in one step [J].
    pub scatter: f64,
    /// Slope of the least-squares line through the errors of Pi over time [W].
    pub drift: f64,
}

/// Largest constraint residuals over all steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct ViolationSummary {
    /// Residual of the positions [m or rad].
    pub position: f64,
    /// Residual of the velocities [m/s or rad/s].
    pub velocity: f64,
    /// Residual of the accelerations [m/s^2 or rad/s^2].
    pub acceleration: f64,
}

/// Method that `auto` chose, with the reasons.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct MethodChoice {
    /// Formulation of the method that ran.
    pub formulation: String,
    /// Formulation, integrator, and step or tolerance that the run used.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub ran: String,
    /// Reasons for the choice, one sentence each.
    pub reasons: Vec<String>,
    /// Evidence from measurements; absent if nothing was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evidence: Option<PilotReport>,
}

impl RunSummary {
    /// Returns one JSON object, indented and without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // All keys are strings and the sink is memory, so serialisation cannot fail.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
