//! The journal of a sweep: a head line, then one line for each finished member in the order of completion.
//!
//! A line counts once its line end is written. What a kill left of a line is cut off, and its member runs again.

use crate::settings::Overrides;
use core::fmt::{self, Display, Formatter};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

const FILE: &str = "sweep.journal";
const KIND: &str = "mbs sweep journal";

/// Rows by member, as texts.
type Rows = BTreeMap<usize, Vec<String>>;

/// What a journal belongs to: version, and hashes of scene, sweep and options.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Head([String; 5]);

/// An open journal, locked for this process.
#[derive(Debug)]
pub(super) struct Journal {
    file: File,
}

/// A journal that cannot be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum JournalError {
    /// It belongs to another sweep; what has changed.
    Other(&'static str),
    /// The file of that name is no journal.
    NotAJournal,
    /// Another process is writing it.
    Busy,
    /// It cannot be read or written.
    Io(io::Error),
}

impl Head {
    pub(super) fn new(scene: &str, sweep: &str, overrides: &Overrides) -> Self {
        let hash = |text: &str| format!("{:016x}", fnv(text.as_bytes()));
        let options = hash(&format!("{overrides:?}"));
        let version = env!("CARGO_PKG_VERSION").to_owned();
        Self([KIND.to_owned(), version, hash(scene), hash(sweep), options])
    }

    fn line(&self) -> String {
        self.0.join(",") + "\n"
    }

    /// Is a journal with this first line ours?
    fn check(&self, line: &str) -> Result<(), JournalError> {
        let found: Vec<&str> = line.split(',').collect();
        let what = ["", "the version of mbs", "the scene", "the sweep", "an option"];
        if found.len() != self.0.len() || found[0] != KIND {
            return Err(JournalError::NotAJournal);
        }
        match (1..found.len()).find(|&i| found[i] != self.0[i]) {
            Some(i) => Err(JournalError::Other(what[i])),
            None => Ok(()),
        }
    }
}

impl Journal {
    /// Opens the journal of a directory, or begins it, and gives the rows that are whole. `shape` is the number of cells of a
    /// row and that of members.
    pub(super) fn open(
        out: &Path,
        head: &Head,
        (n_cells, n_members): (usize, usize),
        anew: bool,
    ) -> Result<(Self, Rows), JournalError> {
        let path = out.join(FILE);
        let mut options = OpenOptions::new();
        let mut file = options.read(true).write(true).create(true).truncate(false).open(path)?;
        // a file system without locks has none to lose
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(JournalError::Busy);
        }
        let mut bytes = Vec::new();
        if !anew {
            file.read_to_end(&mut bytes)?;
        }
        let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        // a head that was torn is begun again, anything else is not ours to overwrite
        if whole == 0 && !head.line().as_bytes().starts_with(&bytes) {
            return Err(JournalError::NotAJournal);
        }
        let text = String::from_utf8_lossy(&bytes[..whole]);
        let mut rows = Rows::new();
        if let Some((first, rest)) = text.split_once('\n') {
            head.check(first)?;
            rows = read_rows(rest, n_cells, n_members);
        }
        file.set_len(whole as u64)?;
        file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            file.write_all(head.line().as_bytes())?;
        }
        Ok((Self { file }, rows))
    }

    /// Appends a row, in one write.
    pub(super) fn append(&mut self, cells: &[String]) -> io::Result<()> {
        let mut line = csv::Writer::from_writer(Vec::new());
        line.write_record(cells)?;
        let line = line.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
        self.file.write_all(&line)
    }
}

/// The rows that have all their cells; others are of members that run again.
fn read_rows(text: &str, n_cells: usize, n_members: usize) -> Rows {
    let mut reader = csv::ReaderBuilder::new();
    let lines = text.lines().filter_map(|line| {
        let mut reader = reader.has_headers(false).flexible(true).from_reader(line.as_bytes());
        let record = reader.records().next()?.ok()?;
        let cells: Vec<String> = record.iter().map(str::to_owned).collect();
        let member = cells.first()?.parse::<usize>().ok()?.checked_sub(1)?;
        (cells.len() == n_cells && member < n_members).then_some((member, cells))
    });
    lines.collect()
}

/// FNV-1a of 64 bits: tells a changed text, and is the same everywhere.
fn fnv(bytes: &[u8]) -> u64 {
    const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    bytes.iter().fold(BASIS, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

impl JournalError {
    /// What to do about it.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Other(_) => "give another directory with --out, or begin anew with --restart",
            Self::NotAJournal => "give another directory with --out, or remove the file",
            Self::Busy => "wait for it, or give another directory with --out",
            Self::Io(_) => "give a directory that can be made or written with --out",
        }
    }
}

impl Display for JournalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Other(what) => {
                write!(f, "the directory has the results of another sweep: {what} has changed")
            }
            Self::NotAJournal => {
                write!(f, "`{FILE}` in the directory is not the journal of a sweep")
            }
            Self::Busy => write!(f, "another process is running a sweep in the directory"),
            Self::Io(error) => write!(f, "the journal cannot be used: {error}"),
        }
    }
}

impl core::error::Error for JournalError {}

impl From<io::Error> for JournalError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_the_published_test_vectors() {
        assert_eq!(fnv(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(fnv(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn rows_without_all_their_cells_are_left_out() {
        let rows = read_rows("2,a,b\n1,\"x, y\",z\n3,a\n9,a,b\nx,a,b\n\u{0},\n0,a,b\n", 3, 3);
        assert_eq!(rows.keys().copied().collect::<Vec<_>>(), [0, 1]);
        assert_eq!(rows[&0], ["1", "x, y", "z"]);
    }
}
