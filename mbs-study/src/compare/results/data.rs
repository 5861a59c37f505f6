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
    /// Length of the runs that are compared [s]: less where the reference is not known to the end.
    pub compared: f64,
    /// Number of instants at which errors are taken, equally spaced, the start left out.
    pub instants: usize,
    /// Distance of the instants [s].
    pub interval: f64,
    /// Least number of timings of each run.
    pub repeats: u32,
    /// Scales that errors of each output are divided by.
    pub outputs: Vec<OutputScale>,
    /// Reference that errors are taken against.
    pub reference: Reference,
    /// The methods, in a fixed order.
    pub methods: Vec<MethodRuns>,
    /// Who is fastest at which error.
    pub ranking: Vec<RankLevel>,
    /// Choices of `auto` at each error; empty where that was not asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<JudgedChoice>,
    /// Maps of where the augmented formulations converge, over step and penalty.
    pub maps: Vec<ConvergenceMap>,
    /// Notes for the reader.
    pub notes: Vec<String>,
    /// Origin of the comparison: how it was made.
    pub provenance: Origin,
}

/// Origin of a comparison: how it was made.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Origin {
    /// The command line that makes it again.
    pub command: String,
    /// Version of the program.
    pub version: String,
    /// Commit it was built from, where the build set it.
    pub commit: String,
    /// Profile and target features of the build.
    pub build: String,
    /// Name of the processor.
    pub cpu: String,
    /// Hash of the scene file's text.
    pub scene_hash: String,
}

impl Origin {
    /// Label and text of each that is not empty.
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

/// Components of one unit of a channel, and the scale of their errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct OutputScale {
    /// Name of the channel.
    pub output: String,
    /// Unit of these components.
    pub unit: String,
    /// Errors are divided by it; nothing where the output and all others of its unit are constant: it is not compared.
    pub scale: Option<f64>,
    /// The largest range of a component over the reference.
    pub range: f64,
    /// Columns of these components in a row of all components.
    #[serde(skip)]
    pub columns: Vec<usize>,
}

/// Reference that errors are taken against.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Kind of the reference: `computed` or `table`.
    pub kind: String,
    /// Description of the reference in one line.
    pub method: String,
    /// Uncertainty of the reference, on the scale of the errors. It is the largest distance of its two runs, or half a unit of the last digit
    /// of a table.
    pub uncertainty: f64,
    /// Check of the reference by another formulation.
    pub cross_check: Option<CrossCheck>,
    /// The instant after which it is not known well enough [s].
    pub known_until: Option<f64>,
    /// Whether another method agrees with the reference within its uncertainty, or the reference is a table.
    pub is_verified: bool,
}

/// The reference against another formulation.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CrossCheck {
    /// Description of the check in one line.
    pub method: String,
    /// Largest distance from the reference, on the scale of the errors.
    pub difference: f64,
    /// Uncertainty of the check itself: the distance of its two extrapolations.
    pub own_uncertainty: f64,
    /// Uncertainty of the check itself, under the name that other references have for it.
    #[serde(default)]
    pub uncertainty: f64,
}

impl CrossCheck {
    /// The check by `method`, with its largest distance from the reference.
    #[must_use]
    pub fn new(method: &str, difference: f64, uncertainty: f64) -> Self {
        Self { method: method.to_owned(), difference, own_uncertainty: uncertainty, uncertainty }
    }
}

/// A method, and its runs from the coarsest to the finest.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct MethodRuns {
    /// Name: formulation, integrator and control, precision.
    pub name: String,
    /// Name of the formulation.
    pub formulation: String,
    /// Name of the integrator.
    pub integrator: String,
    /// Control of the steps: `fixed`, `error`, `energy`; `own` with an integrator that controls its own.
    pub control: String,
    /// Precision: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Runs of the method.
    pub runs: Vec<RunEntry>,
    /// Slope of the error against the step.
    pub fit: Option<Fit>,
    /// CPU time at each error of the ranking [s]; nothing where it is not reached.
    pub at_error: Vec<Option<f64>>,
}

/// Status of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Run that was not made: it would take too long, or would show nothing more.
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
    /// Time reached over steps made [s].
    pub mean_step: f64,
    /// Number of iterations, or evaluations.
    pub iterations: u64,
    /// Largest error over outputs and instants, in their scales.
    pub error: Option<f64>,
    /// Root of the mean square of the same.
    pub error_rms: Option<f64>,
    /// The error is less than three times the reference's uncertainty: the reference does not resolve it.
    pub is_below_reference: bool,
    /// CPU time of the steps, each time anew from a fresh start, in the order of the repeats [s].
    pub cpu_seconds: Vec<f64>,
    /// The least of them [s].
    pub cpu_least: Option<f64>,
    /// CPU time of the run whose steps were timed one by one [s]: longer, as the clock is read at every step.
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
    /// Largest |Pi(t) - Pi(0)| [J].
    pub max_error: Option<f64>,
    /// Energy turned over [J].
    pub turned_over: Option<f64>,
    /// Slope of the straight line through the errors [W].
    pub drift: Option<f64>,
    /// Root of the mean square of the changes from step to step [J].
    pub scatter: Option<f64>,
}

/// CPU times of single steps [s].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StepTimes {
    /// Half of the steps take less.
    pub p50: f64,
    /// All but one in a hundred take less.
    pub p99: f64,
    /// Time of the slowest step.
    pub max: f64,
    /// Lower edge of a class and the steps in it; ten classes a decade.
    pub classes: Vec<(f64, u64)>,
}

/// Slope of a method's error against its step.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Fit {
    /// Order, the slope of the line; nothing where no three runs lie on a line.
    pub order: Option<f64>,
    /// Largest and smallest step of the runs on the line [s].
    pub steps: Option<[f64; 2]>,
    /// Number of the runs on the line.
    pub points: usize,
    /// The step below which errors grow again as it falls [s]: rounding.
    pub rounding_below: Option<f64>,
}

/// Who is fastest at an error.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct RankLevel {
    /// Error of the outputs at which methods are ranked.
    pub error: f64,
    /// Reason why there is no ranking at this error.
    pub note: Option<String>,
    /// Up to this factor times are called equal to the fastest of their rank.
    pub apart: f64,
    /// Formulations with integrators that reach the error, by rank; those of a rank in the order of the methods.
    pub ranks: Vec<Rank>,
    /// Formulations with integrators that do not reach the error.
    pub not_reached: Vec<String>,
}

/// A choice by measurement, compared with the times of all methods.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JudgedChoice {
    /// Error that is wanted.
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
    /// Choices that stopped before the one that is reported, each with its reason.
    pub stopped: Vec<String>,
    /// CPU time of the run [s], the least of several; nothing where all stopped.
    pub cpu_seconds: Option<f64>,
    /// Error of the run against the reference.
    pub true_error: Option<f64>,
    /// The method that takes least at this error.
    pub best_method: Option<String>,
    /// CPU time of the best method, measured interleaved with the chosen run [s].
    pub best_seconds: Option<f64>,
    /// The chosen run's time over that.
    pub over_best: Option<f64>,
}

/// A formulation with an integrator, by its fastest control and precision.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Rank {
    /// 1 plus the number of those that are faster; the same for those that are called equal.
    pub rank: usize,
    /// Name of the formulation and integrator.
    pub name: String,
    /// The method that is meant.
    pub method: String,
    /// CPU time at the error [s], the least of the repeats.
    pub seconds: f64,
    /// The second of the repeats over the least, minus one.
    pub noise: f64,
}

/// Does Newton's method converge, and how large is the error, over step and fixed penalty?
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
    /// A row for each penalty, a cell for each step.
    pub cells: Vec<Vec<Cell>>,
}

/// A run with one step and one penalty.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// Largest error of the run; nothing where it stopped.
    pub error: Option<f64>,
    /// Mean number of iterations.
    pub iterations: f64,
    /// Code of what stopped it; empty where it did not.
    pub failure: String,
}

impl Comparison {
    /// One JSON object in indented form, without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // all keys are texts and the sink is memory: serialisation has nothing to fail on
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
