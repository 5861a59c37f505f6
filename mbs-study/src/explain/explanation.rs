//! Explanation of a scene by `mbs explain`, as plain data with the keys of its JSON object.

use mbs::record::{MethodChoice, OutputChange, PilotReport, RunError, alias};
use serde::Serialize;

/// Explanation of a scene: what is simulated, what is not, and the cost of each effect. Numbers that are not finite are written as `null`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Explanation {
    /// Name of the scene.
    pub scene: String,
    /// Formulation as asked, `auto` included.
    pub formulation: String,
    /// Choice of `auto` and its reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<MethodChoice>,
    /// The candidates of a choice by measurement: by structure, or with what a pilot measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<PilotReport>,
    /// Name of the integrator.
    pub integrator: String,
    /// Precision: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Dimension of the scene: 2 or 3.
    pub dimension: usize,
    /// Step of the run [s].
    pub step: f64,
    /// Length of the run [s].
    pub duration: f64,
    /// Reason why the scene does not start, or why the run that was measured stopped.
    pub error: Option<RunError>,
    /// Parts of the scene that are simulated.
    pub simulated: Simulated,
    /// Every effect of the scene.
    pub effects: Vec<EffectEntry>,
    /// Missing things that the scene could have.
    pub absent: Vec<MissingEffect>,
    /// Costs of the effects; `None` where the scene does not start.
    #[serde(flatten, serialize_with = "alias::prices")]
    pub prices: Option<EffectCosts>,
}

/// Bodies, joints, guides, and the sizes of the model.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Simulated {
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// Joints of the scene by kind.
    pub joints: Vec<JointsByKind>,
    /// Guided joints of the scene.
    pub guides: Vec<GuideEntry>,
    /// Names of the couplings; the key is left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub couplings: Vec<String>,
    /// Names of the bodies' contacts that roll, and of blades; the key is left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rollings: Vec<String>,
    /// Acceleration of gravity [m/s^2], where it acts.
    pub gravity: Option<Vec<f64>>,
    /// Coordinates minus rank in natural coordinates, at the start.
    pub dof: Option<usize>,
    /// The model in natural coordinates.
    pub natural: Option<Sizes>,
    /// The model in relative coordinates.
    pub relative: Option<Relative>,
    /// Reason why there is no model in relative coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative_error: Option<RunError>,
    /// Thin rods in space.
    #[serde(flatten, serialize_with = "alias::rods")]
    pub rods: Vec<ThinRod>,
}

/// Joints of one kind.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct JointsByKind {
    /// Kind, as in scene files.
    pub kind: String,
    /// Names, in the order of the file.
    pub names: Vec<String>,
}

/// Guide of a joint.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct GuideEntry {
    /// Name of the joint.
    pub joint: String,
    /// `table`, `sine`, `ramp`, `input`.
    pub law: String,
}

/// Sizes of a model at the start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Sizes {
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of constraint rows.
    pub constraints: usize,
    /// Rank of the constraint rows.
    pub constraint_rank: usize,
    /// Rows beyond the rank.
    pub redundant: usize,
    /// Degrees of freedom: coordinates minus rank.
    pub dof: usize,
}

impl Sizes {
    /// From coordinates, constraints and rank.
    #[must_use]
    pub fn new([coordinates, constraints, constraint_rank]: [usize; 3]) -> Self {
        let redundant = constraints.saturating_sub(constraint_rank);
        let dof = coordinates.saturating_sub(constraint_rank);
        Self { coordinates, constraints, constraint_rank, redundant, dof }
    }
}

/// The model in relative coordinates.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Relative {
    /// Joint freedoms of the tree, equations of the loops, their rank.
    #[serde(flatten)]
    pub sizes: Sizes,
    /// Number of closed loops: as many as joints are cut.
    pub loops: usize,
    /// Names of the joints that are cut.
    pub cut_joints: Vec<String>,
    /// One step on a controller; `None` where the scene has a signal that no controller's tables have.
    pub controller: Option<ControllerStep>,
}

/// The bound of one step of bounded work: operations, by a closed formula in the structure of the model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct ControllerStep {
    /// Number of products.
    pub products: u64,
    /// Number of sums and differences.
    pub sums: u64,
    /// Number of quotients.
    pub quotients: u64,
    /// Number of square roots.
    pub roots: u64,
    /// Sines with cosines, and arc tangents.
    pub turns: u64,
    /// Instructions in single and in double precision, at most.
    pub instructions: [u64; 2],
}

/// A thin rod in space, which has no inertia about itself.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct ThinRod {
    /// Name of the body.
    pub body: String,
    /// Is its spin about itself a coordinate in natural coordinates? It is where a joint holds more than points of its line.
    pub idle_spin_carried: bool,
}

/// An effect of the scene.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct EffectEntry {
    /// Name of the effect.
    pub name: String,
    /// Kind, as in scene files.
    pub kind: String,
    /// Is the effect switched on?
    pub enabled: bool,
}

/// Something that the scene has not.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct MissingEffect {
    /// A short fixed word for programs.
    #[serde(flatten, serialize_with = "alias::what")]
    pub what: String,
    /// Description of what is missing, in one line.
    pub text: String,
}

/// Costs and changes of each effect, measured by leaving it out.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct EffectCosts {
    /// Steps of each timed run.
    pub timed_steps: u64,
    /// Number of timings of each run.
    pub repeats: u32,
    /// CPU time per step with all effects, the least of the repeats [s].
    pub seconds_per_step: Option<f64>,
    /// CPU time per step of watching the energy invariant, part of the above in every run and every formulation [s].
    pub monitor_seconds_per_step: Option<f64>,
    /// Length of the runs that are compared, from the start [s].
    pub compared_duration: f64,
    /// The run with all effects reached that.
    pub completed: bool,
    /// Newton iterations (or evaluations) per step in that run.
    pub iterations_per_step: f64,
    /// The largest step with all effects.
    pub largest_step: LargestStep,
    /// Each enabled effect alone left out.
    pub effects: Vec<EffectCost>,
    /// All effects of a kind left out together, for kinds with more than one.
    pub kinds: Vec<EffectCost>,
}

/// Cost of effects: what leaving them out saves and changes.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct EffectCost {
    /// Names of what is left out.
    pub names: Vec<String>,
    /// Kind of the effects.
    pub kind: String,
    /// CPU time per step without them [s].
    pub seconds_per_step: Option<f64>,
    /// 1 - (CPU time per step without) / (with all); negative where it becomes slower.
    pub share: Option<f64>,
    /// Distance of the second best repeat from the best, as a share; the worse of the two runs.
    pub noise: Option<f64>,
    /// The share is not larger than the noise.
    pub below_noise: Option<bool>,
    /// The run without them reached the end.
    pub completed: bool,
    /// Newton iterations (or evaluations) per step in it.
    pub iterations_per_step: f64,
    /// Reason why the run without them did not reach the end.
    pub error: Option<RunError>,
    /// The largest step without them.
    pub largest_step: LargestStep,
    /// Changes in the outputs.
    #[serde(flatten, serialize_with = "alias::changes")]
    pub changes: Vec<OutputChange>,
}

impl EffectCost {
    /// The change that is largest beside its range, if there is more than rounding.
    #[must_use]
    pub fn largest_change(&self) -> Option<&OutputChange> {
        let size = |change: &OutputChange| (change.relative.unwrap_or(0.0), change.largest);
        self.changes.iter().filter(|change| !change.is_rounding).max_by(|a, b| {
            let ((a, x), (b, y)) = (size(a), size(b));
            a.total_cmp(&b).then(x.total_cmp(&y))
        })
    }
}

/// The largest step with which the run completes, found by doubling.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct LargestStep {
    /// Largest step [s]; `None` when the run does not even complete with the given one.
    pub step: Option<f64>,
    /// End of the doubling.
    pub end: SearchEnd,
}

/// End of the search for the largest step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SearchEnd {
    /// The time allowed for measuring was used up.
    #[default]
    NotMeasured,
    /// A step twice as long stops.
    Stops,
    /// Longer steps were not tried: 64 times the given one, or a tenth of the run.
    Limit,
}

impl Explanation {
    /// One JSON object in indented form, without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // all keys are texts and the sink is memory: serialisation has nothing to fail on
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
