//! Writer that keeps a run while it goes: a checkpoint now and then, and its rows in their files.

use super::rows::Rows;
use crate::checkpoint::CheckpointError;
use crate::folder::{PART, write_whole};
use crate::recorder::Recorder;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// The file of a run's checkpoint in its directory.
pub const FILE: &str = "checkpoint.mbs";

/// Most rows that wait until they are written. Chosen, not tuned.
const MOST_WAITING: usize = 256;
/// Time by which a checkpoint may be early, relative to the interval of two [-]: times are rounded. Chosen, not tuned.
const EARLY: f64 = 1e-6;

/// The bytes of a checkpoint, or why there are none.
type Bytes = Result<Vec<u8>, CheckpointError>;

/// Writer of a run's checkpoints: where and how often a run is kept.
///
/// At its start, and at the first step that ends at or after each multiple of a simulated time, a new checkpoint replaces that in the
/// directory. It is written beside it, synced, renamed. No step is made shorter for it. The rows are written as the run goes, to
/// `run.csv` and `steps.csv` in [`PART`], so that the results of an earlier run stay until there are new ones. A write that fails is
/// tried again the next time, and reported in the end.
#[derive(Debug)]
pub struct CheckpointWriter {
    out: PathBuf,
    every: f64,
    /// When the next one is due [s].
    next: f64,
    rows: Rows,
    failure: Option<io::Error>,
    /// Lock on the directory, until it is released.
    lock: Option<File>,
}

impl CheckpointWriter {
    /// Into a directory, made if missing, each `every` [s] of simulated time. The directory is locked until this is dropped or released.
    ///
    /// # Errors
    /// [`CheckpointError::Busy`] where another process keeps a run there, [`CheckpointError::Io`] where there is no directory.
    pub fn new(out: &Path, every: f64) -> Result<Self, CheckpointError> {
        fs::create_dir_all(out)?;
        // Where directories cannot be opened or locked there is no lock to be had.
        let lock = File::open(out).ok();
        if let Some(Err(TryLockError::WouldBlock)) = lock.as_ref().map(File::try_lock) {
            return Err(CheckpointError::Busy);
        }
        let (out, rows) = (out.to_owned(), Rows::default());
        Ok(Self { out, every, next: f64::NEG_INFINITY, rows, failure: None, lock })
    }

    /// Frees the directory for other runs.
    pub fn release(&mut self) {
        self.lock = None;
    }

    /// Path of the checkpoint.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.out.join(FILE)
    }

    /// Error of the last attempt to write; nothing where it has not failed.
    #[must_use]
    pub fn failure(&self) -> Option<&io::Error> {
        self.failure.as_ref()
    }

    /// Simulated time between two checkpoints [s].
    pub fn every(&self) -> f64 {
        self.every
    }

    /// Is a checkpoint due at time `t` [s]?
    pub fn is_due(&self, t: f64) -> bool {
        t >= self.next
    }

    /// Are there rows enough to be written?
    pub fn is_waiting(&self, recorder: &Recorder) -> bool {
        self.rows.waiting(recorder) >= MOST_WAITING
    }

    /// Writes the rows so far, and the bytes of a checkpoint at time `t` [s] where there is one.
    pub fn write(&mut self, recorder: &Recorder, checkpoint: Option<(f64, Bytes)>) {
        let mut done = self.rows.write(&self.out.join(PART), recorder);
        if let Some((t, bytes)) = checkpoint {
            let bytes = bytes.map_err(|error| io::Error::other(error.to_string()));
            let write = |bytes: Vec<u8>| write_whole(&self.out, FILE, &bytes).map_err(|e| e.error);
            done = done.and(bytes.and_then(write));
            self.next = ((t / self.every + EARLY).floor() + 1.0 - EARLY) * self.every;
        }
        self.failure = done.err();
    }
}
