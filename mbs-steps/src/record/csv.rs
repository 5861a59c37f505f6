//! CSV with one row per recorded time, written during the run.

use super::channel::Channel;
use super::series::StepSeries;
use mbs_core::real::DoubleDouble;
use mbs_scene::format::{full, shortest};
use std::io::{self, Write};

/// Writes a header, and then one row for each recorded time. Floats have the shortest form that reads back exactly.
///
/// Rows are flushed to the file every [`CsvWriter::FLUSH_EVERY`] rows, at [`CsvWriter::finish`], and when the writer is dropped. A run that
/// stops therefore keeps its recorded rows.
#[derive(Debug)]
pub struct CsvWriter<W: Write> {
    out: csv::Writer<W>,
    n_columns: usize,
    n_rows: usize,
}

impl<W: Write> CsvWriter<W> {
    /// Number of rows between two flushes. Chosen, not tuned.
    pub const FLUSH_EVERY: usize = 256;

    /// Starts a file with its header: `t`, then the columns of the channels.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn new(sink: W, channels: &[Channel]) -> io::Result<Self> {
        let mut out = csv::Writer::from_writer(sink);
        let header: Vec<String> = core::iter::once("t".to_owned())
            .chain(channels.iter().flat_map(Channel::columns))
            .collect();
        out.write_record(&header).map_err(io::Error::from)?;
        out.flush()?;
        Ok(Self { out, n_columns: header.len(), n_rows: 0 })
    }

    /// Writes a line with the units: first the unit of the time, then the units of the channels.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn units(&mut self, channels: &[Channel]) -> io::Result<()> {
        let of_channel = |channel: &Channel| channel.components.clone();
        let units = channels.iter().flat_map(of_channel).map(|component| component.unit);
        let units: Vec<String> = core::iter::once("s".to_owned()).chain(units).collect();
        self.out.write_record(&units).map_err(io::Error::from)
    }

    /// Continues a file that already has a header.
    pub fn append(sink: W, channels: &[Channel]) -> Self {
        let n_columns = 1 + channels.iter().map(|channel| channel.components.len()).sum::<usize>();
        Self { out: csv::Writer::from_writer(sink), n_columns, n_rows: 0 }
    }

    /// Writes one row with the time [s] and the components of all channels in order.
    ///
    /// # Errors
    /// The errors of the sink.
    ///
    /// # Panics
    /// If the number of values differs from the number of columns.
    pub fn row(&mut self, time: f64, values: &[f64]) -> io::Result<()> {
        self.fields(core::iter::once(&time).chain(values).map(|&x| shortest(x)))
    }

    /// Writes one row of values with 32 digits. The time has the digits of `f64`.
    ///
    /// # Errors
    /// The errors of the sink.
    ///
    /// # Panics
    /// If the number of values differs from the number of columns.
    pub fn long_row(&mut self, time: f64, values: &[DoubleDouble]) -> io::Result<()> {
        self.fields(core::iter::once(shortest(time)).chain(values.iter().map(|&x| full(x))))
    }

    fn fields(&mut self, fields: impl Iterator<Item = String>) -> io::Result<()> {
        let mut n = 0;
        for field in fields {
            self.out.write_field(field).map_err(io::Error::from)?;
            n += 1;
        }
        assert_eq!(n, self.n_columns, "one value per column");
        self.out.write_record(None::<&[u8]>).map_err(io::Error::from)?;
        self.n_rows += 1;
        if self.n_rows.is_multiple_of(Self::FLUSH_EVERY) {
            self.out.flush()?;
        }
        Ok(())
    }

    /// Writes the buffered rows to the sink.
    ///
    /// # Errors
    /// The errors of the sink.
    pub fn finish(mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes one row for each recorded step: the time at its end, its length, and its counts and errors.
///
/// # Errors
/// The errors of the sink.
pub fn write_steps(sink: impl Write, steps: &StepSeries) -> io::Result<()> {
    let mut out = csv::Writer::from_writer(sink);
    let header = [
        "t",
        "step",
        "index",
        "iterations",
        "rejected",
        "energy_error",
        "energy_change",
        "penalty_energy",
        "error_estimate",
        "limit",
    ];
    out.write_record(header).map_err(io::Error::from)?;
    write_step_rows(out, steps)
}

/// Continues a file that already has the header of [`write_steps`].
///
/// # Errors
/// The errors of the sink.
pub fn append_steps(sink: impl Write, steps: &StepSeries) -> io::Result<()> {
    write_step_rows(csv::Writer::from_writer(sink), steps)
}

fn write_step_rows<W: Write>(mut out: csv::Writer<W>, steps: &StepSeries) -> io::Result<()> {
    for ((&t, &error), row) in steps.times.iter().zip(&steps.energy_errors).zip(&steps.rows) {
        let record = [
            shortest(t),
            shortest(row.length),
            row.index.map_or_else(String::new, |i| i.to_string()),
            row.iterations.to_string(),
            row.rejected.to_string(),
            shortest(error),
            shortest(row.energy_change),
            shortest(row.penalty_energy),
            row.error_estimate.map_or_else(String::new, shortest),
            row.limit.unwrap_or_default().to_owned(),
        ];
        out.write_record(record).map_err(io::Error::from)?;
    }
    out.flush()
}
