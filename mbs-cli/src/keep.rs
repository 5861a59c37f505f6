//! Checkpoints of `mbs run`, and runs that are resumed from them.

use crate::refusal::Refusal;
use crate::say::warn;
use clap::Args;
use mbs::{CHECKPOINT, Checkpoint, CheckpointError, CheckpointWriter, Method, RunConflict, words};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Arguments of a run that is kept.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Write DIR/checkpoint.mbs at the start and after each SECONDS of simulated time. Default: no checkpoint.
    ///
    /// Rows are written while the run advances, so that --resume can continue a run that was killed. Steps and results do not change.
    #[arg(long, value_name = "SECONDS", requires = "out", allow_hyphen_values = true)]
    checkpoint: Option<f64>,
    /// Resume from DIR/checkpoint.mbs, or from FILE, with the settings of its run. Results have the bits of an uninterrupted run.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, conflicts_with = "restart")]
    resume: Option<Option<PathBuf>>,
    /// Discard the checkpoint that an earlier start left in the directory.
    #[arg(long, requires = "out")]
    restart: bool,
}

/// Checkpoint from which a run resumes, and the times of its own checkpoints.
#[derive(Debug, Default)]
pub(crate) struct RunCheckpoints {
    pub(crate) from: Option<Checkpoint>,
    /// Folder of the run's checkpoints, and the simulated time between two of them [s].
    pub(crate) into: Option<(PathBuf, f64)>,
    /// Path of the checkpoint in the directory of the results.
    checkpoint: Option<PathBuf>,
}

impl Arguments {
    /// Reads the checkpoint from which to resume, if there is one; otherwise returns the refusal.
    pub(crate) fn begin(&self, out: Option<&Path>) -> Result<RunCheckpoints, Refusal> {
        let interval = self.checkpoint.map_or(Ok(()), RunConflict::check_interval);
        interval.map_err(|error| Refusal::new("settings-refused", error, error.hint()))?;
        let checkpoint = out.map(|out| out.join(CHECKPOINT));
        let Some(path) = self.resumed(out)? else {
            return Ok(RunCheckpoints { checkpoint, ..RunCheckpoints::default() });
        };
        let from = Checkpoint::open(&path).map_err(|error| refusal(&path, &error))?;
        Ok(RunCheckpoints { from: Some(from), into: None, checkpoint })
    }

    /// The file from which to resume.
    fn resumed(&self, out: Option<&Path>) -> Result<Option<PathBuf>, Refusal> {
        match (&self.resume, out) {
            (None, _) => Ok(None),
            (Some(Some(file)), _) => Ok(Some(file.clone())),
            (Some(None), Some(out)) => Ok(Some(out.join(CHECKPOINT))),
            (Some(None), None) => Err(Refusal::new(
                "checkpoint-refused",
                "there is no directory to resume in",
                "give --out DIR, or --resume=FILE",
            )),
        }
    }

    /// Sets the folder and the interval of the run's checkpoints, if there are any. No other process writes to the folder meanwhile.
    /// Refuses a folder with the checkpoint of another unfinished run.
    pub(crate) fn keep(
        &self,
        out: Option<&Path>,
        kept: &mut RunCheckpoints,
    ) -> Result<(), Refusal> {
        let Some(out) = out else { return Ok(()) };
        let there = out.join(CHECKPOINT);
        match self.resumed(Some(out))? {
            None if there.exists() && !self.restart => {
                return Err(unfinished(
                    out,
                    "continue with --resume, or begin anew with --restart",
                ));
            }
            Some(file) if is_another(&there, &file) => {
                return Err(unfinished(
                    out,
                    "give another directory with --out, or remove the file",
                ));
            }
            _ => {}
        }
        let stored = kept.from.as_ref().map(Checkpoint::every).filter(|every| *every > 0.0);
        if let Some(every) = self.checkpoint.or(stored) {
            kept.into = Some((out.to_owned(), every));
        }
        Ok(())
    }
}

/// True if the file exists and is a different file from the other path.
fn is_another(file: &Path, other: &Path) -> bool {
    file.exists() && file.canonicalize().ok() != other.canonicalize().ok()
}

/// The refusal of a directory in which a run is unfinished.
fn unfinished(out: &Path, hint: &str) -> Refusal {
    let at = Checkpoint::open(&out.join(CHECKPOINT));
    let at = at.map(|c| format!(", at t = {} s", words::time(c.time()))).unwrap_or_default();
    let message = format!("`{}` has the checkpoint of a run that has not ended{at}", out.display());
    Refusal::new("run-unfinished", message, hint)
}

impl RunCheckpoints {
    /// Returns the given settings, and the settings of the checkpoint where none is given; otherwise the refusal.
    pub(crate) fn overrides(&self, given: Method) -> Result<Method, Refusal> {
        let Some(from) = &self.from else { return Ok(given) };
        from.overrides(&given).map_err(|error| Refusal::checkpoint(&error))
    }

    /// Removes the checkpoint after the results are written, unless the run was interrupted. Reports an error that occurred while
    /// checkpoints were written.
    pub(crate) fn end(&self, writer: Option<&CheckpointWriter>, is_interrupted: bool) {
        if let Some(writer) = writer
            && let Some(error) = writer.failure()
        {
            let (path, error) = (writer.path(), crate::say::plain(error));
            warn(&format!(
                "warning: the last checkpoint could not be written: cannot write to `{}`: {error}",
                path.display()
            ));
        }
        if is_interrupted && writer.is_some() {
            return;
        }
        if let Some(checkpoint) = &self.checkpoint {
            // an error is ignored: the file may not exist
            let _ = std::fs::remove_file(checkpoint);
        }
    }
}

fn refusal(path: &Path, error: &CheckpointError) -> Refusal {
    let path = path.display();
    match error {
        CheckpointError::Io(error) if error.kind() == ErrorKind::NotFound => Refusal::new(
            "checkpoint-refused",
            format!("there is no checkpoint `{path}`"),
            "a run has one if it is begun with --checkpoint SECONDS, and until it has ended",
        ),
        error => Refusal::new("checkpoint-refused", format!("`{path}`: {error}"), error.hint()),
    }
}
