//! Summary of a run as JSON, with the keys of the scene format.

use super::choice::PilotReport;
use super::estimate::ErrorEstimate;
use super::outputs::Outputs;
use super::realtime::RealtimeSummary;
use super::series::ControlSummary;
use super::statistics::ChannelSummary;

/// The summary of a run: one JSON object. Numbers that are not finite are written as `null`.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct RunSummary {
    /// Name of the scene.
    pub scene: String,
    /// Formulation as asked, `auto` included.
    pub formulation: String,
    /// Integrator that the run used.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub integrator: String,
    /// Precision of the run: `f32`, `f64`, `dd`.
    pub precision: String,
    /// The method that ran, and its steps.
    pub method_used: MethodUsed,
    /// Dimension of the scene, 2 or 3.
    pub dimension: usize,
    /// Coordinates of the formulation that ran.
    pub coordinates: usize,
    /// Constraint rows of the formulation that ran.
    pub constraints: usize,
    /// Rank of their Jacobian at the start.
    pub constraint_rank: usize,
    /// Degrees of freedom: coordinates minus rank.
    pub dof: usize,
    /// Step as asked [s].
    pub step: f64,
    /// Number of steps done.
    pub steps: u64,
    /// The whole duration was reached.
    pub completed: bool,
    /// Reason why the whole duration was not reached.
    pub error: Option<RunError>,
    /// Time that the run reached [s].
    pub end_time: f64,
    /// CPU time of all threads from the first step to the last; of a paced run the time of its periods by the clock [s].
    pub cpu_seconds: f64,
    /// Time reached over the time it took.
    pub real_time_factor: f64,
    /// The slowest step [s].
    pub worst_step_seconds: f64,
    /// Newton iterations of all steps.
    pub iterations: u64,
    /// Factorisations of all steps.
    pub factorizations: u64,
    /// Energy invariant over the run.
    pub energy: EnergySummary,
    /// Largest constraint violation over the run.
    pub violation: ViolationSummary,
    /// Summary of the step size control; absent where steps are fixed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub control: Option<ControlSummary>,
    /// Report of how the run kept up with the clock; absent where it was not paced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub realtime: Option<RealtimeSummary>,
    /// Values of the channels at `end_time`.
    pub outputs: Outputs,
    /// Statistics of each channel over every step.
    pub channels: Vec<ChannelSummary>,
    /// The outputs as texts of 32 digits, where the run had them: most readers of JSON keep no more than 17.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub digits: Option<Outputs<String>>,
    /// Accuracy of the outputs; absent where no estimate was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub estimate: Option<ErrorEstimate>,
    /// Method that `auto` chose, and why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<MethodChoice>,
    /// Joints whose reaction is not unique; the smallest one is given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_unique: Vec<String>,
    /// When bumpers, limits and tires made and broke contact, in order.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub contacts: Vec<Contact>,
    /// Number of contacts beyond those that are listed.
    #[serde(skip_serializing_if = "is_zero")]
    pub contacts_left_out: u64,
}

/// The method that ran, and its steps.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct MethodUsed {
    /// Formulation of the method that ran.
    pub formulation: String,
    /// Integrator of the method that ran.
    pub integrator: String,
    /// Number of steps done.
    pub steps: u64,
    /// The shortest step [s]; absent where the integrator makes steps within those that are observed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest_step: Option<f64>,
    /// The longest step [s]; absent there too.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_step: Option<f64>,
    /// Time reached over the number of steps [s].
    pub mean_step: f64,
}

/// A contact made or broken.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Contact {
    /// When, interpolated within the step [s].
    pub time: f64,
    /// Name of the effect.
    pub effect: String,
    /// `lower` or `upper` end of a limit.
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
    /// Short fixed word for programs, such as `not-converged`.
    pub code: String,
    /// Message of one sentence.
    pub message: String,
    /// Time that the run reached [s].
    pub time: f64,
    /// Name of the joint concerned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<String>,
    /// Name of the body concerned.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// Hint on what to try.
    pub hint: String,
}

/// The energy invariant Pi = T + V - work of non-conservative forces and guides, in joules.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct EnergySummary {
    /// Pi at the start.
    pub initial: f64,
    /// Largest |Pi(t) - Pi(0)| over every step.
    pub max_error: f64,
    /// |Pi - Pi(0)| at the end.
    pub final_error: f64,
    /// Largest kinetic energy, plus the work done without regard to its sign: what errors compare with.
    pub turned_over: f64,
    /// Root of the mean square of its changes from step to step.
    pub scatter: f64,
    /// Slope of the straight line through its errors, by least squares [W].
    pub drift: f64,
}

/// Largest residuals over every step.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct ViolationSummary {
    /// Position level [m or rad].
    pub position: f64,
    /// Velocity level [m/s or rad/s].
    pub velocity: f64,
    /// Acceleration level [m/s^2 or rad/s^2].
    pub acceleration: f64,
}

/// Method that `auto` chose, and why.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct MethodChoice {
    /// Formulation of the method that ran.
    pub formulation: String,
    /// Formulation, integrator, and step or tolerance that ran.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub ran: String,
    /// Reasons for the choice, one sentence each.
    pub reasons: Vec<String>,
    /// Evidence that was measured; absent where nothing was.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evidence: Option<PilotReport>,
}

impl RunSummary {
    /// One JSON object in indented form, without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // all keys are texts and the sink is memory: serialisation has nothing to fail on
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
