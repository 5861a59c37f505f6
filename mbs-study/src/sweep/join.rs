//! Table of a sweep whose parts have run separately.

use super::parts::{PartsError, SweepPart};
use super::{Report, Rows, Study, SweepError, whole_rows};
use crate::journal::{JournalError, read};
use mbs::folder::WriteError;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::Instant;

impl Study {
    /// Writes the table of all parts in a directory. Except for CPU times, it is the table of the sweep in one run.
    ///
    /// # Errors
    /// [`SweepError::Parts`]; a journal of another scene, sweep, option or version; a directory that cannot be read.
    pub fn join(&self, out: &Path) -> Result<Report, SweepError> {
        let clock = Instant::now();
        let unread =
            |error| SweepError::Write(WriteError { path: out.to_owned(), bytes: 0, error });
        let mut parts = BTreeSet::new();
        for entry in std::fs::read_dir(out).map_err(unread)? {
            let name = entry.map_err(unread)?.file_name();
            parts.extend(name.to_str().and_then(SweepPart::of_file));
        }
        let Some(&first) = parts.first() else { return Err(PartsError::None.into()) };
        if let Some(&other) = parts.iter().find(|part| part.of != first.of) {
            return Err(PartsError::Counts(first, other).into());
        }
        let (mut rows, mut unfinished) = (Rows::new(), Vec::new());
        // parts with a number beyond that of the members are empty, and need not have run
        for number in 1..=first.of.min(self.n_members()) {
            let part = SweepPart { number, ..first };
            let n = part.members(self.n_members()).len();
            let own = self.rows_of(out, part)?;
            if own.len() < n {
                unfinished.push((part, [n - own.len(), n]));
            }
            rows.extend(own);
        }
        if !unfinished.is_empty() {
            return Err(PartsError::Unfinished(unfinished).into());
        }
        let resumed = rows.len();
        let tables = self.write(out, &rows);
        Ok(self.report((rows, resumed), (1, clock, 0.0), tables))
    }

    /// Finished members of a part; none if the part has no journal.
    fn rows_of(&self, out: &Path, part: SweepPart) -> Result<Rows, SweepError> {
        let lines = match read(out, &part.file(), &self.head) {
            Err(JournalError::Io(error)) if error.kind() == std::io::ErrorKind::NotFound => {
                Vec::new()
            }
            lines => lines?,
        };
        let rows = whole_rows(lines, self.columns.len(), self.n_members());
        part.check(rows.keys())?;
        Ok(rows)
    }
}
