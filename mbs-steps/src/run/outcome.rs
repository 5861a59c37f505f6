//! Outcome of a run: its summary, and the data of its files.

use crate::kept::{Head, write_rows};
use crate::record::{Channel, ErrorEstimate, Provenance, RunRecord, RunSummary, StepSeries};
use crate::stop::StopError;
use crate::words::summary_rows;
use mbs_core::real::DoubleDouble;
use std::io;

/// Outcome of a run: its summary, and the data of its files.
#[derive(Debug)]
pub struct Outcome {
    /// Summary of the run, as in the JSON object.
    pub summary: RunSummary,
    /// Reason why the run stopped early.
    pub error: Option<StopError>,
    pub(super) record: RunRecord,
    pub(super) channels: Vec<Channel>,
    pub(super) table: Vec<(f64, Vec<f64>)>,
    /// Rows with all digits, if the run has more digits than `f64`.
    pub(super) long_table: Vec<Vec<DoubleDouble>>,
    pub(super) ranges: Vec<[f64; 2]>,
    pub(super) steps: StepSeries,
}

impl Outcome {
    /// Writes the rows as CSV.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn write_csv(&self, sink: impl io::Write) -> io::Result<()> {
        let table = self.table.iter().map(|(t, row)| (*t, &row[..]));
        write_rows((sink, &self.channels), Head::Names, table, self.long_table.iter().cloned())
    }

    /// Writes the rows as CSV, with the units as the second line.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn write_csv_with_units(&self, sink: impl io::Write) -> io::Result<()> {
        let table = self.table.iter().map(|(t, row)| (*t, &row[..]));
        write_rows((sink, &self.channels), Head::Units, table, self.long_table.iter().cloned())
    }

    /// Writes the steps as CSV: their lengths, counts and errors.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn write_steps(&self, sink: impl io::Write) -> io::Result<()> {
        crate::record::write_steps(sink, &self.steps)
    }

    /// The data of the steps at the recorded rows.
    #[must_use]
    pub fn steps(&self) -> &StepSeries {
        &self.steps
    }

    /// Record that the HTML page of the run shows, completed by the given provenance.
    #[must_use]
    pub fn record(&self, provenance: Provenance) -> RunRecord {
        RunRecord { provenance, ..self.record.clone() }
    }

    /// Rows of the run: time and all components of all channels.
    #[must_use]
    pub fn rows(&self) -> &[(f64, Vec<f64>)] {
        &self.table
    }

    /// Names and units of the components of the rows, as in the columns of `run.csv`.
    #[must_use]
    pub fn columns(&self) -> [Vec<String>; 2] {
        let components = self.channels.iter().flat_map(|channel| &channel.components);
        let units = components.map(|component| component.unit.to_string()).collect();
        [self.channels.iter().flat_map(Channel::columns).collect(), units]
    }

    /// The channels of the rows.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Adds an estimate of the errors; its warnings become notes.
    #[doc(hidden)]
    pub fn take_estimate(&mut self, estimate: ErrorEstimate) {
        self.record.notes.extend(estimate.warnings.iter().cloned());
        self.summary.estimate = Some(estimate);
        self.record.summary = summary_rows(&self.summary);
    }

    /// Least and greatest value of each component of each channel, from its statistics; empty if the run did not start. In a run that
    /// records only the last row, these values cover only the recorded rows.
    #[must_use]
    pub fn ranges(&self) -> &[[f64; 2]] {
        &self.ranges
    }

    /// Notes for the user about the run.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.record.notes
    }
}
