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

/// Result of a run: a table, a summary and, for a run that stopped early, the reason.
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
    /// Table of the outputs over time. The first call builds the columns.
    #[must_use]
    pub fn table(&self) -> &Table {
        self.table.get_or_init(|| Table::new(self.outcome.channels(), self.outcome.rows()))
    }

    /// Reason why the run stopped early, if it did. The table then ends at the time of the stop.
    #[must_use]
    pub fn stop(&self) -> Option<SimulationError> {
        let Outcome { summary, error, .. } = &self.outcome;
        let stop = SimulationError::stopped(error.clone()?, summary.end_time, &self.names);
        // the hint of the summary may name another method that was tried
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

    /// Settings that the run was made with. For a run with a goal they are the chosen settings.
    #[must_use]
    pub fn settings(&self) -> &ResolvedMethod {
        &self.settings
    }

    /// The mechanism whose inputs follow the table of the run; `None` for a run without a table.
    #[must_use]
    pub fn driven_mechanism(&self) -> Option<&Mechanism> {
        self.mechanism.as_ref()
    }

    /// Outcome of the run, from which its files and its report page are made.
    #[must_use]
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }

    /// Returns the outcome of the run and drops the rest.
    #[must_use]
    pub fn into_outcome(self) -> Outcome {
        self.outcome
    }

    /// Writer of the run's checkpoints, which reports the checkpoints that it could not write. Another run may use the folder again.
    #[must_use]
    pub fn checkpoints(&self) -> Option<&CheckpointWriter> {
        self.checkpoints.as_ref()
    }

    /// Outcome of the run, to which a study adds its estimate of the errors, and the settings of the run.
    #[doc(hidden)]
    pub fn outcome_mut(&mut self) -> (&mut Outcome, &ResolvedMethod) {
        (&mut self.outcome, &self.settings)
    }
}
