//! The rows of a run in its files, as it goes.

use crate::record::{Channel, ControlSummary, CsvWriter, append_steps, write_steps};
use crate::recorder::Recorder;
use mbs_core::real::DoubleDouble;
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Files of rows, and of steps.
const FILES: [&str; 2] = ["run.csv", "steps.csv"];

/// Progress of the files: the rows that they have, and their thinning.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// Number of rows in the files.
    n: usize,
    /// The thinning that they have; where it has changed since, and where they could not be written, they are written anew.
    thinning: u64,
    /// Rows that there were when they were written last, or could not be.
    tried: usize,
}

impl Rows {
    /// Rows since the files were written last, or could not be.
    pub(super) fn waiting(&self, recorder: &Recorder) -> usize {
        recorder.n_rows().saturating_sub(self.tried)
    }

    /// Brings the files of a directory up to date, by whole lines. The first time, and where rows were thinned, they are replaced.
    pub(super) fn write(&mut self, out: &Path, recorder: &Recorder) -> io::Result<()> {
        let is_anew = self.thinning != recorder.thinning();
        let from = if is_anew { 0 } else { self.n };
        let (n, tried) = (recorder.n_rows(), recorder.n_rows());
        // until all is written, nothing is
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

/// The lines of both files from a row on; from the first with their headers.
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

/// Head that stands before the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Head {
    /// No head, as the file has it.
    None,
    /// The names of the columns.
    Names,
    /// The names, then the units.
    Units,
}

/// Writes rows as CSV, with all digits where there are long ones.
///
/// # Errors
/// What the sink refuses.
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
