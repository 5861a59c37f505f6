//! Files of the rows of a run, written during the run.

use crate::record::{Channel, ControlSummary, CsvWriter, append_steps, write_steps};
use crate::recorder::Recorder;
use mbs_core::real::DoubleDouble;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Names of the files of rows and of steps.
const FILES: [&str; 2] = ["run.csv", "steps.csv"];

/// Progress of the files: the number of their rows, and the number of steps per row.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// Number of rows in the files.
    n: usize,
    /// Number of steps per row in the files. If it has changed, or if a write failed, the files are written again from the first row.
    thinning: u64,
    /// Number of recorded rows at the last write, successful or not.
    tried: usize,
}

impl Rows {
    /// Number of rows since the last write, successful or not.
    pub(super) fn waiting(&self, recorder: &Recorder) -> usize {
        recorder.n_rows().saturating_sub(self.tried)
    }

    /// Appends the new rows to the files of a directory, as complete lines. The files are replaced at the first write, and after the
    /// recorder has removed rows.
    pub(super) fn write(&mut self, out: &Path, recorder: &Recorder) -> io::Result<()> {
        let is_anew = self.thinning != recorder.thinning();
        let from = if is_anew { 0 } else { self.n };
        let (n, tried) = (recorder.n_rows(), recorder.n_rows());
        // If the write fails, the files count as empty and are replaced next time.
        *self = Self { n: 0, thinning: 0, tried };
        if is_anew {
            fs::create_dir_all(out)?;
        }
        for (file, text) in FILES.iter().zip(texts(recorder, from)?) {
            let path = out.join(file);
            let mut options = OpenOptions::new();
            let options = if is_anew {
                options.create(true).write(true).truncate(true)
            } else {
                options.append(true)
            };
            options.open(path)?.write_all(&text)?;
        }
        *self = Self { n, thinning: recorder.thinning(), tried };
        Ok(())
    }
}

/// Returns the lines of both files, beginning with row `from`. If `from` is 0, the header lines are included.
fn texts(recorder: &Recorder, from: usize) -> io::Result<[Vec<u8>; 2]> {
    let (mut rows, mut steps) = (Vec::new(), Vec::new());
    let table = recorder.table().skip(from);
    let long = recorder.long_table().skip(from);
    let head = if from == 0 { Head::Names } else { Head::None };
    write_rows((&mut rows, &recorder.channels), head, table, long)?;
    let series = recorder.step_series(from, ControlSummary::default());
    if from == 0 {
        write_steps(&mut steps, &series)?;
    } else {
        append_steps(&mut steps, &series)?;
    }
    Ok([rows, steps])
}

/// Header lines before the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Head {
    /// No header, because the file already has one.
    None,
    /// A line with the names of the columns.
    Names,
    /// A line with the names, then a line with the units.
    Units,
}

/// Writes rows as CSV. If `long` has values with more digits than `f64`, all their digits are written.
///
/// # Errors
/// The errors of the sink.
pub fn write_rows<'a>(
    (sink, channels): (impl Write, &[Channel]),
    head: Head,
    table: impl Iterator<Item = (f64, &'a [f64])>,
    mut long: impl Iterator<Item = Vec<DoubleDouble>>,
) -> io::Result<()> {
    let mut csv = match head {
        Head::None => CsvWriter::append(sink, channels),
        Head::Names | Head::Units => CsvWriter::new(sink, channels)?,
    };
    if head == Head::Units {
        csv.units(channels)?;
    }
    for (t, row) in table {
        match long.next() {
            Some(row) => csv.long_row(t, &row)?,
            None => csv.row(t, row)?,
        }
    }
    csv.finish()
}
