//! Explanation of a scene by `mbs explain`, as plain data with the keys of its JSON object.

use mbs::record::{MethodChoice, OutputChange, PilotReport, RunError, alias};
use serde::Serialize;

/// Explanation of a scene: simulated parts, missing effects, and the cost of each effect. Numbers that are not finite are written as `null`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Explanation {
    /// Name of the scene.
    pub scene: String,
    /// Requested formulation, which may be `auto`.
    pub formulation: String,
    /// Choice of `auto` and its reason.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chosen: Option<MethodChoice>,
    /// Candidates of a choice by measurement: with facts of the scene's structure, or also with trials of a pilot.
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
    /// Reason why the scene does not start, or why the measured run stopped.
    pub error: Option<RunError>,
    /// Parts of the scene that are simulated.
    pub simulated: Simulated,
    /// Every effect of the scene.
    pub effects: Vec<EffectEntry>,
    /// Effects that the scene could have and does not have.
    pub absent: Vec<MissingEffect>,
    /// Costs of the effects; `None` if the scene does not start.
    #[serde(flatten, serialize_with = "alias::prices")]
    pub prices: Option<EffectCosts>,
}

/// Simulated parts: bodies, joints, guides, and the sizes of the model.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Simulated {
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// Joints of the scene by kind.
    pub joints: Vec<JointsByKind>,
    /// Guided joints of the scene.
    pub guides: Vec<GuideEntry>,
    /// Names of the couplings. The key is left out if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub couplings: Vec<String>,
    /// Names of rolling contacts and of blades. The key is left out if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rollings: Vec<String>,
    /// Acceleration of gravity [m/s^2], if there is gravity.
    pub gravity: Option<Vec<f64>>,
    /// Degrees of freedom at the start: natural coordinates minus the rank of their constraints.
    pub dof: Option<usize>,
    /// Sizes of the model in natural coordinates.
    pub natural: Option<Sizes>,
    /// Model in relative coordinates.
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
    /// Names of the joints, in the order of the file.
    pub names: Vec<String>,
}

/// Guide of a joint.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct GuideEntry {
    /// Name of the joint.
    pub joint: String,
    /// Law of the guide: `table`, `sine`, `ramp` or `input`.
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
    /// Number of rows minus their rank.
    pub redundant: usize,
    /// Degrees of freedom: coordinates minus rank.
    pub dof: usize,
}

impl Sizes {
    /// Makes sizes from coordinates, constraints and rank.
    #[must_use]
    pub fn new([coordinates, constraints, constraint_rank]: [usize; 3]) -> Self {
        let redundant = constraints.saturating_sub(constraint_rank);
        let dof = coordinates.saturating_sub(constraint_rank);
        Self { coordinates, constraints, constraint_rank, redundant, dof }
    }
}

/// Model in relative coordinates.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Relative {
    /// Degrees of freedom of the tree's joints, equations of the closed loops, and their rank.
    #[serde(flatten)]
    pub sizes: Sizes,
    /// Number of closed loops, which is the number of cut joints.
    pub loops: usize,
    /// Names of the cut joints.
    pub cut_joints: Vec<String>,
    /// Cost of one step on a controller. `None` if the scene has a signal that a controller's tables cannot represent.
    pub controller: Option<ControllerStep>,
}

/// Upper bound of the operations of one step with bounded work. A closed formula in the structure of the model gives it.
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
    /// Number of pairs of sine and cosine, and of arc tangents.
    pub turns: u64,
    /// Largest number of instructions in single and in double precision.
    pub instructions: [u64; 2],
}

/// Thin rod in space, without moment of inertia about its axis.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct ThinRod {
    /// Name of the body.
    pub body: String,
    /// True if the rotation about the rod's axis is part of the natural coordinates. This is the case if a joint constrains more than points of
    /// the axis.
    pub idle_spin_carried: bool,
}

/// An effect of the scene.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct EffectEntry {
    /// Name of the effect.
    pub name: String,
    /// Kind, as in scene files.
    pub kind: String,
    /// True if the effect is switched on.
    pub enabled: bool,
}

/// Effect that the scene does not have.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct MissingEffect {
    /// Key of the effect: a short word for programs, which does not change.
    #[serde(flatten, serialize_with = "alias::what")]
    pub what: String,
    /// Description of the missing effect, in one line.
    pub text: String,
}

/// Costs and changes of each effect, measured by runs without it.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct EffectCosts {
    /// Steps of each timed run.
    pub timed_steps: u64,
    /// Number of timings of each run.
    pub repeats: u32,
    /// CPU time per step with all effects, the shortest of the repeats [s].
    pub seconds_per_step: Option<f64>,
    /// CPU time per step for the energy invariant [s]. It is part of `seconds_per_step`, in every run and every formulation.
    pub monitor_seconds_per_step: Option<f64>,
    /// Length of the compared runs, from the start [s].
    pub compared_duration: f64,
    /// True if the run with all effects reached this length.
    pub completed: bool,
    /// Newton iterations (or evaluations) per step in the run with all effects.
    pub iterations_per_step: f64,
    /// Largest step with which the run with all effects completes.
    pub largest_step: LargestStep,
    /// Costs of each enabled effect, left out alone.
    pub effects: Vec<EffectCost>,
    /// Costs of all effects of a kind, left out together, for kinds with more than one effect.
    pub kinds: Vec<EffectCost>,
}

/// Cost of effects: time saved and outputs changed by leaving them out.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct EffectCost {
    /// Names of the effects that are left out.
    pub names: Vec<String>,
    /// Kind of the effects.
    pub kind: String,
    /// CPU time per step without these effects [s].
    pub seconds_per_step: Option<f64>,
    /// Fraction of the time that the effects cost: 1 - (CPU time per step without them) / (with all) [-]. It is negative if the run is slower
    /// without them.
    pub share: Option<f64>,
    /// Noise of the times: relative difference of the second shortest time from the shortest [-]. It is the larger value of the runs with and
    /// without these effects.
    pub noise: Option<f64>,
    /// True if the fraction is at most as large as the noise.
    pub below_noise: Option<bool>,
    /// True if the run without these effects reached the end.
    pub completed: bool,
    /// Newton iterations (or evaluations) per step in the run without these effects.
    pub iterations_per_step: f64,
    /// Reason why the run without these effects did not reach the end.
    pub error: Option<RunError>,
    /// Largest step with which the run without these effects completes.
    pub largest_step: LargestStep,
    /// Changes of the outputs.
    #[serde(flatten, serialize_with = "alias::changes")]
    pub changes: Vec<OutputChange>,
}

impl EffectCost {
    /// Change that is largest relative to the range of its output, if a change exceeds rounding.
    #[must_use]
    pub fn largest_change(&self) -> Option<&OutputChange> {
        let size = |change: &OutputChange| (change.relative.unwrap_or(0.0), change.largest);
        self.changes.iter().filter(|change| !change.is_rounding).max_by(|a, b| {
            let ((a, x), (b, y)) = (size(a), size(b));
            a.total_cmp(&b).then(x.total_cmp(&y))
        })
    }
}

/// Largest step with which a run completes, found by doubling the step.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct LargestStep {
    /// Largest step [s]; `None` if the run does not complete with the step of the scene.
    pub step: Option<f64>,
    /// Reason why the doubling ended.
    pub end: SearchEnd,
}

/// End of the search for the largest step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SearchEnd {
    /// Search that was not made or completed, because the time for measurements was used up.
    #[default]
    NotMeasured,
    /// Search that ended because a run with twice the step stops.
    Stops,
    /// Search that ended at its limit: 64 times the scene's step, or a tenth of the run.
    Limit,
}

impl Explanation {
    /// Formats the explanation as an indented JSON object, without a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // serialisation cannot fail: all keys are texts, and the sink is memory
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}
