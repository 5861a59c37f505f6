//! Result of a run.

use super::mechanism::Mechanism;
use super::table::Table;
use crate::checkpoint::CheckpointWriter;
use crate::erased::SimulationError;
use crate::names::Names;
use crate::record::RunSummary;
use crate::settings::ResolvedMethod;
use mbs_steps::run::Outcome;
use std::sync::OnceLock;

/// Result of a run: its table, its summary, and why it stopped early, if it did.
#[derive(Debug)]
pub struct RunResult {
    pub(super) outcome: Outcome,
    pub(super) settings: ResolvedMethod,
    pub(super) names: Names,
    pub(super) mechanism: Option<Mechanism>,
    pub(super) checkpoints: Option<CheckpointWriter>,
    pub(super) table: OnceLock<Table>,
}

impl RunResult {
    /// Table of the outputs over time. Cost: its columns are made at the first call.
    #[must_use]
    pub fn table(&self) -> &Table {
        self.table.get_or_init(|| Table::new(self.outcome.channels(), self.outcome.rows()))
    }

    /// Reason why the run stopped early; the table then ends there.
    #[must_use]
    pub fn stop(&self) -> Option<SimulationError> {
        let Outcome { summary, error, .. } = &self.outcome;
        let stop = SimulationError::stopped(error.clone()?, summary.end_time, &self.names);
        // the summary's may name a method that was tried
        Some(match &summary.error {
            Some(report) => stop.with_hint(report.hint.clone()),
            None => stop,
        })
    }

    /// Summary of counts, energies and violations: the object that `mbs run --json` prints.
    #[must_use]
    pub fn summary(&self) -> &RunSummary {
        &self.outcome.summary
    }

    /// Notes that the user should know.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        self.outcome.notes()
    }

    /// Settings that the run was made with: of a goal, those that were chosen.
    #[must_use]
    pub fn settings(&self) -> &ResolvedMethod {
        &self.settings
    }

    /// The mechanism with the table that its inputs followed; none where they followed no table.
    #[must_use]
    pub fn driven_mechanism(&self) -> Option<&Mechanism> {
        self.mechanism.as_ref()
    }

    /// Outcome of the run: what its files and its page are made of.
    #[must_use]
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// Outcome of the run, without the rest.
    #[must_use]
    pub fn into_outcome(self) -> Outcome {
        self.outcome
    }

    /// Writer of the run's checkpoints, which says what it could not write, if anything. The folder is free again.
    #[must_use]
    pub fn checkpoints(&self) -> Option<&CheckpointWriter> {
        self.checkpoints.as_ref()
    }

    /// Outcome of the run, to which a study adds its estimate, and the settings.
    #[doc(hidden)]
    pub fn outcome_mut(&mut self) -> (&mut Outcome, &ResolvedMethod) {
        (&mut self.outcome, &self.settings)
    }
}
