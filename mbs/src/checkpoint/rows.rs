//! The rows of a run in its files, as it goes.

use crate::folder::write_whole;
use crate::recorder::Recorder;
use mbs_core::real::DoubleDouble;
use mbs_scene::{Channel, ControlSummary, CsvWriter, append_steps, write_steps};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Files of rows, and of steps.
const FILES: [&str; 2] = ["run.csv", "steps.csv"];

/// How far the files have come.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// Rows in them.
    n: usize,
    /// The thinning that they have; where it has changed since, they are written anew.
    thinning: u64,
}

impl Rows {
    /// Rows that are not in the files yet.
    pub(super) fn waiting(&self, recorder: &Recorder) -> usize {
        recorder.n_rows().saturating_sub(self.n)
    }

    /// Brings the files of a directory up to date, by whole lines. The first time, and where rows were thinned, they are replaced.
    pub(super) fn write(&mut self, out: &Path, recorder: &Recorder) -> io::Result<()> {
        let is_anew = self.thinning != recorder.thinning();
        let from = if is_anew { 0 } else { self.n };
        if is_anew {
            fs::create_dir_all(out)?;
        }
        for (file, text) in FILES.iter().zip(texts(recorder, from)?) {
            let path = out.join(file);
            if is_anew {
                write_whole(&path, &text)?;
            } else {
                OpenOptions::new().append(true).open(path)?.write_all(&text)?;
            }
        }
        (self.n, self.thinning) = (recorder.n_rows(), recorder.thinning());
        Ok(())
    }
}

/// The lines of both files from a row on; from the first with their headers.
fn texts(recorder: &Recorder, from: usize) -> io::Result<[Vec<u8>; 2]> {
    let (mut rows, mut steps) = (Vec::new(), Vec::new());
    let table = recorder.table().skip(from);
    let long = recorder.long_table().skip(from);
    write_rows((&mut rows, &recorder.channels), from == 0, table, long)?;
    let series = recorder.step_series(from, ControlSummary::default());
    if from == 0 {
        write_steps(&mut steps, &series)?;
    } else {
        append_steps(&mut steps, &series)?;
    }
    Ok([rows, steps])
}

/// Rows as CSV: with all digits where there are long ones.
pub(crate) fn write_rows<'a>(
    (sink, channels): (impl Write, &[Channel]),
    has_header: bool,
    table: impl Iterator<Item = (f64, &'a [f64])>,
    mut long: impl Iterator<Item = Vec<DoubleDouble>>,
) -> io::Result<()> {
    let mut csv = match has_header {
        true => CsvWriter::new(sink, channels)?,
        false => CsvWriter::append(sink, channels),
    };
    for (t, row) in table {
        match long.next() {
            Some(row) => csv.long_row(t, &row)?,
            None => csv.row(t, row)?,
        }
    }
    csv.finish()
}
