//! Collection of the rows of a sweep, from threads or other machines. Each row is written to the journal at once.

use super::{KIND, Report, Rows, Study, SweepError, SweepPart, whole_rows};
use crate::journal::Journal;
use core::num::NonZeroUsize;
use mbs::folder::WriteError;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Rows of a sweep that are available: those of an earlier start, and those added since.
#[derive(Debug)]
pub struct Collection {
    /// Directory, name of the journal in it, and the journal. Without a directory, rows are lost when the process ends.
    kept: Option<(PathBuf, String, Journal)>,
    pub(super) rows: Rows,
    pub(super) resumed: usize,
    begun: Instant,
    cpu_seconds: f64,
}

impl Study {
    /// Collects rows in a directory, including those of an earlier, unfinished start. The journal is locked until the collection is dropped.
    /// Without a directory, rows are in memory only. `anew` discards an earlier journal.
    ///
    /// # Errors
    /// A journal of another scene, sweep or version; a journal in use; a directory that cannot be written.
    pub fn collect(&self, out: Option<&Path>, anew: bool) -> Result<Collection, SweepError> {
        match out {
            Some(out) => self.collect_part(out, anew, None),
            None => Ok(Collection {
                kept: None,
                rows: Rows::new(),
                resumed: 0,
                begun: Instant::now(),
                cpu_seconds: 0.0,
            }),
        }
    }

    /// Collects the rows of a part of the sweep in a directory; see [`Self::collect`].
    pub(super) fn collect_part(
        &self,
        out: &Path,
        anew: bool,
        part: Option<SweepPart>,
    ) -> Result<Collection, SweepError> {
        let begun = Instant::now();
        std::fs::create_dir_all(out).map_err(|error| {
            SweepError::Write(WriteError { path: out.join(""), bytes: 0, error })
        })?;
        let file = part.map_or_else(|| KIND.file.to_owned(), SweepPart::file);
        let (journal, lines) = Journal::open_as((out, &file), &self.head, anew)?;
        let rows = whole_rows(lines, self.columns.len(), self.n_members());
        part.unwrap_or(SweepPart::WHOLE).check(rows.keys())?;
        let resumed = rows.len();
        let kept = Some((out.to_owned(), file, journal));
        Ok(Collection { kept, rows, resumed, begun, cpu_seconds: 0.0 })
    }

    /// Adds a row of cells, in the form of [`Columns::cells`](super::Columns::cells), and writes it to the journal.
    ///
    /// # Errors
    /// A row of another sweep; a journal that cannot be written.
    pub fn take(&self, to: &mut Collection, cells: Vec<String>) -> Result<(), SweepError> {
        let member = cells.first().and_then(|cell| cell.parse::<usize>().ok());
        let member = member.and_then(|member| member.checked_sub(1));
        let member = member.filter(|m| *m < self.n_members() && cells.len() == self.columns.len());
        let Some(member) = member else {
            let error = io::Error::new(io::ErrorKind::InvalidData, "a row of another sweep");
            return Err(SweepError::Write(WriteError { path: PathBuf::new(), bytes: 0, error }));
        };
        if let Some((out, file, journal)) = &mut to.kept {
            journal.append(&cells).map_err(|error| {
                SweepError::Write(WriteError { path: out.join(file), bytes: 0, error })
            })?;
        }
        let cpu = cells.last().and_then(|cell| cell.parse::<f64>().ok());
        to.cpu_seconds += cpu.unwrap_or_default();
        to.rows.insert(member, cells);
        Ok(())
    }

    /// Returns the report of the sweep. With `has_table` and a directory, the table is written.
    #[must_use]
    pub fn report_of(&self, from: Collection, threads: NonZeroUsize, has_table: bool) -> Report {
        let tables = match &from.kept {
            Some((out, ..)) if has_table => self.write(out, &from.rows),
            _ => Ok(Vec::new()),
        };
        let spent = (threads.get(), from.begun, from.cpu_seconds);
        self.report((from.rows, from.resumed), spent, tables)
    }
}

impl Collection {
    /// Returns the members without a row, counted from 0. `n` is the number of all members.
    #[must_use]
    pub fn missing(&self, n: usize) -> Vec<usize> {
        (0..n).filter(|member| !self.rows.contains_key(member)).collect()
    }
}
