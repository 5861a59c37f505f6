//! Results of `mbs compare`, as plain data with the keys of its JSON object.

use mbs::record::RunError;
use serde::{Deserialize, Serialize};

/// Comparison of the methods on one scene by their cost and error.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the scene.
    pub scene: String,
    /// Length of the scene's run [s].
    pub duration: f64,
    /// Length of the compared runs [s]. It is shorter than the duration if the reference is not known to the end.
    pub compared: f64,
    /// Number of equally spaced instants at which errors are computed, without the start.
    pub instants: usize,
    /// Distance of the instants [s].
    pub interval: f64,
    /// Smallest number of timings of each run.
    pub repeats: u32,
    /// Scales that errors of each output are divided by.
    pub outputs: Vec<OutputScale>,
    /// Reference that errors are computed against.
    pub reference: Reference,
    /// Methods of the comparison, in a fixed order.
    pub methods: Vec<MethodRuns>,
    /// Fastest methods at each error.
    pub ranking: Vec<RankLevel>,
    /// Choices by measurement at each error; empty if they were not requested.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<JudgedChoice>,
    /// Convergence maps of the augmented formulations, over step and penalty.
    pub maps: Vec<ConvergenceMap>,
    /// Notes for the reader.
    pub notes: Vec<String>,
    /// Origin of the comparison: how it was made.
    pub provenance: Origin,
}

/// Origin of a comparison: how it was made.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Origin {
    /// Command line that repeats the comparison.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// Commit that the program was built from, if the build recorded it.
    pub commit: String,
    /// Profile and target features of the build.
    pub build: String,
    /// Name of the processor.
    pub cpu: String,
    /// Hash of the scene file's text.
    pub scene_hash: String,
}

impl Origin {
    /// Label and text of each field that is not empty.
    pub fn rows(&self) -> impl Iterator<Item = [&str; 2]> {
        let rows = [
            ["command", self.command.as_str()],
            ["version", &self.version],
            ["commit", &self.commit],
            ["build", &self.build],
            ["processor", &self.cpu],
            ["hash of the scene", &self.scene_hash],
        ];
        rows.into_iter().filter(|[_, value]| !value.is_empty())
    }
}

/// Components of a channel that have the same unit, and the scale of their errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct OutputScale {
    /// Name of the channel.
    pub output: String,
    /// Unit of these components.
    pub unit: String,
    /// Scale that errors are divided by. `None` if this output and all others of its unit are constant: they are not compared.
    pub scale: Option<f64>,
    /// Largest range of a component over the reference.
    pub range: f64,
    /// Columns of these components in a row of all components.
    #[serde(skip)]
    pub columns: Vec<usize>,
}

/// Reference that errors are computed against.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Kind of the reference: `computed` or `table`.
    pub kind: String,
    /// Description of the reference in one line.
    pub method: String,
    /// Uncertainty of the reference, relative to the scales of the errors. It is the largest distance of the reference's two runs, or half a
    /// unit of the last digit of a table.
    pub uncertainty: f64,
    /// Check of the reference by another formulation.
    pub cross_check: Option<CrossCheck>,
    /// Time after which the reference is not known well enough [s].
    pub known_until: Option<f64>,
    /// Whether another method agrees with the reference within its uncertainty, or the reference is a table.
    pub is_verified: bool,
}

/// Comparison of the reference with another formulation.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CrossCheck {
    /// Description of the check in one line.
    pub method: String,
    /// Largest distance from the reference, relative to the scales of the errors.
    pub difference: f64,
    /// Uncertainty of the check: the distance of its two extrapolated solutions.
    pub own_uncertainty: f64,
    /// Uncertainty of the check, repeated under the key that other references have.
    #[serde(default)]
    pub uncertainty: f64,
}

impl CrossCheck {
    /// Makes the check by `method`, with its largest distance from the reference.
    #[must_use]
    pub fn new(method: &str, difference: f64, uncertainty: f64) -> Self {
        Self { method: method.to_owned(), difference, own_uncertainty: uncertainty, uncertainty }
    }
}

/// Method with its runs, from the coarsest to the finest.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct MethodRuns {
    /// Name of the method: formulation, integrator, step control and precision.
    pub name: String,
    /// Name of the formulation.
    pub formulation: String,
    /// Name of the integrator.
    pub integrator: String,
    /// Control of the steps: `fixed`, `error`, `energy`, or `own` for an integrator with its own step control.
    pub control: String,
    /// Precision: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Runs of the method.
    pub runs: Vec<RunEntry>,
    /// Slope of the error against the step.
    pub fit: Option<Fit>,
    /// CPU time at each error of the ranking [s]; `None` if the method does not reach the error.
    pub at_error: Vec<Option<f64>>,
}

/// Status of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Run that was not made, because it would take too long or show nothing more.
    #[default]
    NotRun,
    /// Run that reached the end.
    Completed,
    /// Run that stopped, or did not start.
    Failed,
}

/// One run of a method.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RunEntry {
    /// Step [s], or tolerance.
    pub setting: f64,
    /// Status of the run.
    pub status: Status,
    /// Error with which the run stopped.
    pub failure: Option<RunError>,
    /// Reason why the run was not made.
    pub not_run: Option<String>,
    /// Number of steps made.
    pub steps: u64,
    /// Mean step: time reached divided by the number of steps [s].
    pub mean_step: f64,
    /// Number of iterations or, for explicit methods, evaluations.
    pub iterations: u64,
    /// Largest error over outputs and instants, relative to the scales of the outputs.
    pub error: Option<f64>,
    /// Root mean square of these errors.
    pub error_rms: Option<f64>,
    /// True if the error is less than three times the reference's uncertainty. The reference does not resolve such an error.
    pub is_below_reference: bool,
    /// CPU times of the steps, one for each repetition from a new start [s].
    pub cpu_seconds: Vec<f64>,
    /// Shortest of these CPU times [s].
    pub cpu_least: Option<f64>,
    /// CPU time of the run whose steps were timed one by one [s]. It is longer, as the clock is read at every step.
    pub clocked_seconds: f64,
    /// Energy invariant of the run.
    pub energy: Energy,
    /// Largest violation of the constraints: positions, velocities, accelerations.
    pub violation: [f64; 3],
    /// CPU time of the steps one by one.
    pub step_times: Option<StepTimes>,
}

/// The energy invariant of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Largest error of the energy invariant Pi, |Pi(t) - Pi(0)| [J].
    pub max_error: Option<f64>,
    /// Exchanged energy, turned over between kinetic and potential energy and work [J].
    pub turned_over: Option<f64>,
    /// Slope of the straight line through the errors [W].
    pub drift: Option<f64>,
    /// Root mean square of the changes of the error from step to step [J].
    pub scatter: Option<f64>,
}

/// CPU times of single steps [s].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StepTimes {
    /// Time that half of the steps stay below.
    pub p50: f64,
    /// Time that 99 % of the steps stay below.
    pub p99: f64,
    /// Time of the slowest step.
    pub max: f64,
    /// Histogram: the lower edge of each class, and the number of steps in it. A decade has ten classes.
    pub classes: Vec<(f64, u64)>,
}

/// Slope of a method's error against its step.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Fit {
    /// Order of the method, which is the slope of the line. `None` if no three runs lie on a line.
    pub order: Option<f64>,
    /// Largest and smallest step of the runs on the line [s].
    pub steps: Option<[f64; 2]>,
    /// Number of the runs on the line.
    pub points: usize,
    /// Step below which errors grow again because of rounding [s].
    pub rounding_below: Option<f64>,
}

/// Ranking of the methods at one error.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct RankLevel {
    /// Error of the outputs at which methods are ranked.
    pub error: f64,
    /// Reason why there is no ranking at this error.
    pub note: Option<String>,
    /// Factor up to which times are equal to the fastest time of their rank [-].
    pub apart: f64,
    /// Pairs of formulation and integrator that reach the error, sorted by rank. Within a rank they have the order of the methods.
    pub ranks: Vec<Rank>,
    /// Pairs of formulation and integrator that do not reach the error.
    pub not_reached: Vec<String>,
}

/// A choice by measurement, compared with the times of all methods.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JudgedChoice {
    /// Required error of the run.
    pub error: f64,
    /// The method that was chosen.
    pub method: String,
    /// Setting of the method: its step [s], or tolerance.
    pub setting: f64,
    /// CPU time of the run as the pilot predicted it [s].
    pub predicted_seconds: Option<f64>,
    /// Error of the run as the pilot predicted it.
    pub predicted_error: Option<f64>,
    /// CPU time of the pilot [s].
    pub pilot_seconds: f64,
    /// Chosen methods whose runs stopped before the reported one, each with the reason.
    pub stopped: Vec<String>,
    /// CPU time of the run [s], the shortest of several. `None` if all runs stopped.
    pub cpu_seconds: Option<f64>,
    /// Error of the run against the reference.
    pub true_error: Option<f64>,
    /// Method that is fastest at this error.
    pub best_method: Option<String>,
    /// CPU time of the best method, measured interleaved with the chosen run [s].
    pub best_seconds: Option<f64>,
    /// CPU time of the chosen run divided by that of the best method [-].
    pub over_best: Option<f64>,
}

/// Pair of formulation and integrator, represented by its fastest step control and precision.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Rank {
    /// Rank: 1 plus the number of faster pairs. Pairs with equal times have the same rank.
    pub rank: usize,
    /// Name of the formulation and integrator.
    pub name: String,
    /// Name of the fastest method of this pair.
    pub method: String,
    /// CPU time at the error [s], the shortest of the repeats.
    pub seconds: f64,
    /// Noise of the times: the second shortest time divided by the shortest, minus one.
    pub noise: f64,
}

/// Map of convergence and error over step and fixed penalty.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct ConvergenceMap {
    /// Name of the formulation.
    pub formulation: String,
    /// Name of the precision.
    pub precision: String,
    /// Length of the runs [s].
    pub span: f64,
    /// Unit of the penalty.
    pub unit: String,
    /// Steps, from the longest [s].
    pub steps: Vec<f64>,
    /// Penalties, from the smallest.
    pub penalties: Vec<f64>,
    /// Cells of the map: a row for each penalty, and in it a cell for each step.
    pub cells: Vec<Vec<Cell>>,
}

/// A run with one step and one penalty.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Largest error of the run; `None` if it stopped.
    pub error: Option<f64>,
    /// Mean number of iterations.
    pub iterations: f64,
    /// Error code of a run that stopped; otherwise empty.
    pub failure: String,
}

impl Comparison {
    /// Formats the comparison as an indented JSON object, without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // serialisation cannot fail: all keys are texts, and the sink is memory
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
