//! Journal of a long job: a head line, then one line for each finished part in the order of completion.
//!
//! A line counts only if its line end is written. An incomplete line, left by a killed process, is removed, and its part runs again.

use core::fmt::{self, Display, Formatter};
use mbs::inside::fingerprint;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

/// Kind of a journal: its file, and the job whose results it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind {
    /// Name of the file.
    pub file: &'static str,
    /// First words of the head line.
    pub title: &'static str,
    /// Names of the job, with their articles: of this one ("a sweep") and of a different one ("another sweep").
    pub of: [&'static str; 2],
    /// Names of the texts whose hashes are in the head, in order.
    pub hashes: &'static [&'static str],
}

/// Head of a journal, which identifies the job: version, and hashes of all texts that the results depend on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Head {
    kind: Kind,
    cells: Vec<String>,
}

/// Open journal, locked for this process.
#[derive(Debug)]
pub struct Journal {
    file: File,
}

/// Reason why a journal cannot be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum JournalError {
    /// Journal of another job. The texts are the name of that job, such as "another sweep", and the input that has changed.
    Other([&'static str; 2]),
    /// File that is no journal: its name, and the name of the job.
    NotAJournal(String, &'static str),
    /// Journal that another process is writing, with the name of the job.
    Busy(&'static str),
    /// Journal of a job that was interrupted. It has all parts that were finished before.
    Interrupted,
    /// Journal that cannot be read or written.
    Io(io::Error),
}

impl Head {
    /// Makes the head for results that depend on these texts.
    pub fn new(kind: Kind, texts: &[&str]) -> Self {
        let mut cells = vec![kind.title.to_owned(), env!("CARGO_PKG_VERSION").to_owned()];
        cells.extend(texts.iter().map(|text| hash(text)));
        Self { kind, cells }
    }

    fn line(&self) -> String {
        self.cells.join(",") + "\n"
    }

    /// Checks that the first line of a journal is this head. `name` is the file name in messages.
    fn check(&self, name: &str, line: &str) -> Result<(), JournalError> {
        let found: Vec<&str> = line.split(',').collect();
        if found.len() != self.cells.len() || found[0] != self.kind.title {
            return Err(self.not_ours(name));
        }
        let what = |i: usize| match i {
            1 => "the version of mbs",
            i => self.kind.hashes.get(i - 2).copied().unwrap_or("something"),
        };
        match (1..found.len()).find(|&i| found[i] != self.cells[i]) {
            Some(i) => Err(JournalError::Other([self.kind.of[1], what(i)])),
            None => Ok(()),
        }
    }

    fn not_ours(&self, name: &str) -> JournalError {
        JournalError::NotAJournal(name.to_owned(), self.kind.of[0])
    }

    /// Returns the complete lines after the head. `None` if the head itself is incomplete; the journal is then begun again.
    fn lines(&self, name: &str, bytes: &[u8]) -> Result<Option<Lines>, JournalError> {
        let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let text = String::from_utf8_lossy(&bytes[..whole]);
        match text.split_once('\n') {
            Some((first, rest)) => {
                self.check(name, first)?;
                Ok(Some(Lines { cells: read_lines(rest), bytes: whole }))
            }
            None if self.line().as_bytes().starts_with(bytes) => Ok(None),
            None => Err(self.not_ours(name)),
        }
    }
}

/// Complete lines of a journal.
struct Lines {
    cells: Vec<Vec<String>>,
    /// Number of bytes up to the end of the complete lines.
    bytes: usize,
}

/// Reads the complete lines of a journal without locking it.
pub(crate) fn read(out: &Path, name: &str, head: &Head) -> Result<Vec<Vec<String>>, JournalError> {
    let lines = head.lines(name, &std::fs::read(out.join(name))?)?;
    Ok(lines.map(|lines| lines.cells).unwrap_or_default())
}

impl Journal {
    /// Opens the journal of a directory, or begins one, and returns its complete lines. `anew` discards an existing journal.
    ///
    /// # Errors
    /// [`JournalError`] if the journal belongs to another job, is in use, or cannot be written.
    pub fn open(
        out: &Path,
        head: &Head,
        anew: bool,
    ) -> Result<(Self, Vec<Vec<String>>), JournalError> {
        Self::open_as((out, head.kind.file), head, anew)
    }

    /// Opens a journal as [`Self::open`] does, under another file name.
    pub(crate) fn open_as(
        (out, name): (&Path, &str),
        head: &Head,
        anew: bool,
    ) -> Result<(Self, Vec<Vec<String>>), JournalError> {
        let path = out.join(name);
        let mut options = OpenOptions::new();
        let mut file = options.read(true).write(true).create(true).truncate(false).open(path)?;
        // a file system without locks is used without one
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(JournalError::Busy(head.kind.of[0]));
        }
        let mut bytes = Vec::new();
        if !anew {
            file.read_to_end(&mut bytes)?;
        }
        let lines = head.lines(name, &bytes)?;
        file.set_len(lines.as_ref().map_or(0, |lines| lines.bytes as u64))?;
        file.seek(SeekFrom::End(0))?;
        if lines.is_none() {
            file.write_all(head.line().as_bytes())?;
        }
        Ok((Self { file }, lines.map(|lines| lines.cells).unwrap_or_default()))
    }

    /// Appends a line to the file by a single write.
    pub(crate) fn append<S: AsRef<[u8]>>(&mut self, cells: &[S]) -> io::Result<()> {
        let mut line = csv::Writer::from_writer(Vec::new());
        line.write_record(cells)?;
        let line = line.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
        self.file.write_all(&line)
    }
}

/// Parses the cells of each line.
fn read_lines(text: &str) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new();
    let lines = text.lines().filter_map(|line| {
        let mut reader = reader.has_headers(false).flexible(true).from_reader(line.as_bytes());
        let record = reader.records().next()?.ok()?;
        Some(record.iter().map(str::to_owned).collect())
    });
    lines.collect()
}

/// Hash of a text, which shows whether the text has changed.
pub(crate) fn hash(text: &str) -> String {
    format!("{:016x}", fingerprint(text.as_bytes()))
}

impl JournalError {
    /// Returns a hint at what to do about the error.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Other(_) => "give another directory with --out, or begin anew with --restart",
            Self::NotAJournal(..) => "give another directory with --out, or remove the file",
            Self::Busy(_) => "wait for it, or give another directory with --out",
            Self::Interrupted => {
                "start it again to continue: what is finished is kept in the directory"
            }
            Self::Io(_) => "give a directory that can be made or written with --out",
        }
    }
}

impl Display for JournalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Other([of, what]) => {
                write!(f, "the directory has the results of {of}: {what} has changed")
            }
            Self::NotAJournal(file, of) => {
                write!(f, "`{file}` in the directory is not the journal of {of}")
            }
            Self::Busy(of) => write!(f, "another process is running {of} in the directory"),
            Self::Interrupted => write!(f, "interrupted by a signal"),
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
