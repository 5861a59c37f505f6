//! Plain data that a run leaves behind: channels, pictures, energies, counts.

use super::RecordedMotion;
use super::channel::Channel;
use super::statistics::ComponentStatistics;

/// Everything the page of a run shows. Series may have any number of points; the page thins them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunRecord {
    /// Name of the scene.
    pub scene: String,
    /// Origin of the run: how it was made.
    pub provenance: Provenance,
    /// Recorded channels of the run.
    pub channels: Vec<ChannelSeries>,
    /// The motion of the bodies, and what is drawn of them.
    pub motion: Option<RecordedMotion>,
    /// Energies of the mechanism over time.
    pub energy: Option<EnergySeries>,
    /// Constraint violation over time.
    pub violation: Option<ViolationSeries>,
    /// Newton iterations per step.
    pub iterations: Option<IterationSeries>,
    /// Lengths of the steps, where they are controlled.
    pub steps: Option<StepSeries>,
    /// Rows of the summary table: label and value.
    pub summary: Vec<(String, String)>,
    /// Notes that the user should know, such as on redundant constraints.
    pub notes: Vec<String>,
    /// The table of a choice by measurement, its head first.
    pub choice: Vec<Vec<String>>,
    /// When and why the run stopped early: what follows after "The run stopped".
    pub error: Option<String>,
}

/// Origin of a run: how it was made; empty texts are left out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Provenance {
    /// The command line that makes the run again.
    pub command: String,
    /// Precision of the run: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Formulation that the run used.
    pub formulation: String,
    /// Integrator that the run used.
    pub integrator: String,
    /// Step with its unit.
    pub step: String,
    /// Version or commit of the program.
    pub version: String,
    /// Processor of the machine.
    pub cpu: String,
}

impl Provenance {
    /// Label and text of each that is not empty.
    pub fn rows(&self) -> impl Iterator<Item = [&str; 2]> {
        let rows = [
            ["command", self.command.as_str()],
            ["precision", &self.precision],
            ["formulation", &self.formulation],
            ["integrator", &self.integrator],
            ["step", &self.step],
            ["version", &self.version],
            ["processor", &self.cpu],
        ];
        rows.into_iter().filter(|[_, value]| !value.is_empty())
    }
}

/// A channel over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChannelSeries {
    /// Name and components of the channel.
    pub channel: Channel,
    /// Times of the values [s].
    pub times: Vec<f64>,
    /// One series per component, each as long as `times`.
    pub values: Vec<Vec<f64>>,
    /// Statistics over every step, rows or not: of each component, then of the magnitude of each vector.
    pub stats: Vec<ComponentStatistics>,
}

/// Energies over time [J].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EnergySeries {
    /// Times of the energies [s].
    pub times: Vec<f64>,
    /// Kinetic energy T of the mechanism.
    pub kinetic: Vec<f64>,
    /// Potential energy V of the mechanism.
    pub potential: Vec<f64>,
    /// Pi(t) - Pi(0) of the invariant Pi = T + V - work.
    pub invariant_error: Vec<f64>,
}

/// Largest residual at the three levels over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViolationSeries {
    /// Times of the residuals [s].
    pub times: Vec<f64>,
    /// Position level [m or rad].
    pub position: Vec<f64>,
    /// Velocity level [m/s or rad/s].
    pub velocity: Vec<f64>,
    /// Acceleration level [m/s^2 or rad/s^2].
    pub acceleration: Vec<f64>,
}

/// Newton iterations per step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IterationSeries {
    /// Ends of the steps [s].
    pub times: Vec<f64>,
    /// Iterations of each step.
    pub counts: Vec<u32>,
}

/// The steps that a run made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepSeries {
    /// Ends of the steps [s].
    pub times: Vec<f64>,
    /// Pi(t) - Pi(0) there [J].
    pub energy_errors: Vec<f64>,
    /// Rows of the steps, at the same times.
    pub rows: Vec<StepRow>,
    /// Counts over all steps, those that are not kept among them.
    pub totals: ControlSummary,
}

/// Row of a step, or of several in a row where they are thinned: the shortest, and the largest of the rest.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepRow {
    /// Length of the step [s].
    pub length: f64,
    /// 1 or 3, in formulations that have an index.
    pub index: Option<u8>,
    /// Iterations of the step.
    pub iterations: u32,
    /// Trials before it that were rejected.
    pub rejected: u32,
    /// Change of the invariant in it [J].
    pub energy_change: f64,
    /// Energy that the penalties held after the first correction [J].
    pub penalty_energy: f64,
    /// Estimate of its error, relative to the scene's length.
    pub error_estimate: Option<f64>,
    /// Limit that kept the next step from being longer: `max`, `energy`, `error`, `event`, `contact`, `failure`.
    pub limit: Option<&'static str>,
}

impl StepRow {
    /// This step together with one before it that is not kept.
    #[must_use]
    pub fn after(&self, before: &Self) -> Self {
        if before.length == 0.0 {
            return self.clone();
        }
        let change = [self.energy_change, before.energy_change];
        Self {
            length: if self.length > 0.0 { self.length.min(before.length) } else { before.length },
            index: self.index.min(before.index),
            iterations: self.iterations.max(before.iterations),
            rejected: self.rejected + before.rejected,
            energy_change: if change[0].abs() < change[1].abs() { change[1] } else { change[0] },
            penalty_energy: self.penalty_energy.max(before.penalty_energy),
            error_estimate: [self, before]
                .iter()
                .filter_map(|row| row.error_estimate)
                .reduce(f64::max),
            limit: self.limit.or(before.limit),
        }
    }
}

/// Summary of the control of the step size.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ControlSummary {
    /// `energy`, `energy-printed`, `error` or `both`.
    pub rule: &'static str,
    /// Number of steps kept.
    pub accepted: u64,
    /// Trials rejected, or shortened to end at an event.
    pub rejected: u64,
    /// The shortest step [s].
    pub smallest_step: f64,
    /// Longest step of the run [s].
    pub largest_step: f64,
    /// Changes of the index, both ways.
    pub index_changes: u64,
    /// Number of steps in index-1.
    pub index_1_steps: u64,
    /// Steps that ended at an event.
    pub events: u64,
}

impl ControlSummary {
    /// Counts a step that is kept.
    pub fn take(&mut self, step: &StepRow) {
        self.accepted += 1;
        self.rejected += u64::from(step.rejected);
        self.largest_step = self.largest_step.max(step.length);
        let is_first = self.accepted == 1;
        self.smallest_step =
            if is_first { step.length } else { self.smallest_step.min(step.length) };
        self.index_1_steps += u64::from(step.index == Some(1));
        self.events += u64::from(step.limit == Some("event"));
    }
}
