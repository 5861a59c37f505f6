//! Writer that saves checkpoints and rows of a run at intervals.

use super::rows::Rows;
use crate::checkpoint::CheckpointError;
use crate::folder::{PART, write_whole};
use crate::recorder::Recorder;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Name of the checkpoint file in the directory of a run.
pub const FILE: &str = "checkpoint.mbs";

/// Number of unwritten rows at which rows are written. Chosen, not tuned.
const MOST_WAITING: usize = 256;
/// Time by which a checkpoint may be too early, relative to the interval of checkpoints [-], because times have rounding errors. Chosen,
/// not tuned.
const EARLY: f64 = 1e-6;

/// The bytes of a checkpoint, or the error that prevented them.
type Bytes = Result<Vec<u8>, CheckpointError>;

/// Writer of a run's checkpoints, into a directory and at an interval of simulated time.
///
/// The first checkpoint is written at the start of the run. Each further checkpoint is written after the first step that ends at or after a
/// multiple of the interval; no step is shortened for it. The new file is written next to the old file, synced, and renamed to replace it.
///
/// Rows are written during the run to `run.csv` and `steps.csv` in [`PART`]. The results of an earlier run remain until the new results are
/// complete. A failed write is repeated at the next checkpoint, and is reported at the end of the run.
#[derive(Debug)]
pub struct CheckpointWriter {
    out: PathBuf,
    every: f64,
    /// Time of the next checkpoint [s].
    next: f64,
    rows: Rows,
    failure: Option<io::Error>,
    /// Lock on the directory; `None` after its release.
    lock: Option<File>,
}

impl CheckpointWriter {
    /// Creates a writer into a directory, with a checkpoint every `every` [s] of simulated time. The directory is created if it is missing.
    /// It is locked until the writer is dropped or releases it.
    ///
    /// # Errors
    /// [`CheckpointError::Busy`] if another process has locked the directory, [`CheckpointError::Io`] if the directory cannot be created.
    pub fn new(out: &Path, every: f64) -> Result<Self, CheckpointError> {
        fs::create_dir_all(out)?;
        // On systems that cannot open or lock directories, the directory is used without a lock.
        let lock = File::open(out).ok();
        if let Some(Err(TryLockError::WouldBlock)) = lock.as_ref().map(File::try_lock) {
            return Err(CheckpointError::Busy);
        }
        let (out, rows) = (out.to_owned(), Rows::default());
        Ok(Self { out, every, next: f64::NEG_INFINITY, rows, failure: None, lock })
    }

    /// Releases the lock on the directory, so that another run can use it.
    pub fn release(&mut self) {
        self.lock = None;
    }

    /// Path of the checkpoint.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.out.join(FILE)
    }

    /// Error of the last write; `None` if it was successful.
    #[must_use]
    pub fn failure(&self) -> Option<&io::Error> {
        self.failure.as_ref()
    }

    /// Simulated time between two checkpoints [s].
    pub fn every(&self) -> f64 {
        self.every
    }

    /// True if a checkpoint is due at time `t` [s].
    pub fn is_due(&self, t: f64) -> bool {
        t >= self.next
    }

    /// True if there are enough unwritten rows for a write.
    pub fn is_waiting(&self, recorder: &Recorder) -> bool {
        self.rows.waiting(recorder) >= MOST_WAITING
    }

    /// Writes the recorded rows. Also writes a checkpoint if its time `t` [s] and its bytes are given.
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
