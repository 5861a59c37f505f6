//! Plain data of a run: channels, poses, energies and counts.

use super::RecordedMotion;
use super::channel::Channel;
use super::statistics::ComponentStatistics;

/// Data of the HTML page of a run. Series may have any number of points; the page reduces their number.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunRecord {
    /// Name of the scene.
    pub scene: String,
    /// Provenance of the run: method, command and program version.
    pub provenance: Provenance,
    /// Recorded channels of the run.
    pub channels: Vec<ChannelSeries>,
    /// Motion of the bodies, and the shapes to draw.
    pub motion: Option<RecordedMotion>,
    /// Energies of the mechanism over time.
    pub energy: Option<EnergySeries>,
    /// Constraint violation over time.
    pub violation: Option<ViolationSeries>,
    /// Newton iterations of each step.
    pub iterations: Option<IterationSeries>,
    /// Lengths of the steps; `None` for fixed steps.
    pub steps: Option<StepSeries>,
    /// Rows of the summary table, each with label and value.
    pub summary: Vec<(String, String)>,
    /// Notes for the user, for example about redundant constraints.
    pub notes: Vec<String>,
    /// Table of a choice by measurement, with its header row first.
    pub choice: Vec<Vec<String>>,
    /// Time and reason of an early stop. The text follows the words "The run stopped" on the page.
    pub error: Option<String>,
}

/// Provenance of a run: method, command and program version. Empty texts are omitted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Provenance {
    /// Command line with which the run can be repeated.
    pub command: String,
    /// Precision of the run: `f32`, `f64`, `dd`.
    pub precision: String,
    /// Formulation that the run used.
    pub formulation: String,
    /// Integrator that the run used.
    pub integrator: String,
    /// Step length with its unit.
    pub step: String,
    /// Version or commit of the program.
    pub version: String,
    /// Processor of the machine.
    pub cpu: String,
}

impl Provenance {
    /// Returns label and text of each entry that is not empty.
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

/// Values of a channel over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ChannelSeries {
    /// Name and components of the channel.
    pub channel: Channel,
    /// Times of the values [s].
    pub times: Vec<f64>,
    /// One series per component, each as long as `times`.
    pub values: Vec<Vec<f64>>,
    /// Statistics over all steps, including steps without a row. The statistics of the components come first. The statistics of the
    /// magnitude of each vector follow.
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
    /// Error of the energy invariant: Pi(t) - Pi(0), where Pi is T + V minus the work.
    pub invariant_error: Vec<f64>,
}

/// Largest constraint residuals of positions, velocities and accelerations over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ViolationSeries {
    /// Times of the residuals [s].
    pub times: Vec<f64>,
    /// Residual of the positions [m or rad].
    pub position: Vec<f64>,
    /// Residual of the velocities [m/s or rad/s].
    pub velocity: Vec<f64>,
    /// Residual of the accelerations [m/s^2 or rad/s^2].
    pub acceleration: Vec<f64>,
}

/// Newton iterations of each step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct IterationSeries {
    /// Times at the ends of the steps [s].
    pub times: Vec<f64>,
    /// Number of iterations of each step.
    pub counts: Vec<u32>,
}

/// Recorded steps of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepSeries {
    /// Times at the ends of the steps [s].
    pub times: Vec<f64>,
    /// Error of the energy invariant at these times, Pi(t) - Pi(0) [J].
    pub energy_errors: Vec<f64>,
    /// Data of the steps, at the same times.
    pub rows: Vec<StepRow>,
    /// Counts over all steps, including those without a row.
    pub totals: ControlSummary,
}

/// Data of one step, or of several successive steps. For several steps, the length and the index are the smallest ones, and rejected trials
/// are summed. The limit is the last one, and all other values are the largest ones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StepRow {
    /// Length of the step [s].
    pub length: f64,
    /// Index of the formulation, 1 or 3; `None` for a formulation without index changes.
    pub index: Option<u8>,
    /// Number of iterations of the step.
    pub iterations: u32,
    /// Number of rejected trials before the step.
    pub rejected: u32,
    /// Change of the energy invariant in the step [J].
    pub energy_change: f64,
    /// Energy of the penalty forces after the first correction [J].
    pub penalty_energy: f64,
    /// Estimated local error of the step, relative to the scene's length [-].
    pub error_estimate: Option<f64>,
    /// Reason that limits the length of the next step: `max`, `energy`, `error`, `event`, `contact` or `failure`.
    pub limit: Option<&'static str>,
}

impl StepRow {
    /// Combines the data of this step with those of an earlier step that gets no row.
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

/// Summary of the step control.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ControlSummary {
    /// Step rule: `energy`, `energy-printed`, `error` or `both`.
    pub rule: &'static str,
    /// Number of accepted steps.
    pub accepted: u64,
    /// Number of trial steps that were rejected, or shortened to end at an event.
    pub rejected: u64,
    /// Shortest step of the run [s].
    pub smallest_step: f64,
    /// Longest step of the run [s].
    pub largest_step: f64,
    /// Number of index changes, in both directions.
    pub index_changes: u64,
    /// Number of steps in index-1.
    pub index_1_steps: u64,
    /// Number of steps that ended at an event.
    pub events: u64,
}

impl ControlSummary {
    /// Counts an accepted step.
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
