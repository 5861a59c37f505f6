//! How `mbs run` keeps a run, and goes on with one.

use crate::files;
use clap::Args;
use mbs::{CHECKPOINT, Checkpoint, CheckpointError, Keeping, Overrides, Settings, words};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Arguments of a run that is kept.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Write DIR/checkpoint.mbs at the start and each so many simulated seconds, and the rows as the run goes, so that a run that is
    /// killed can go on with --resume. No step and no result changes by it.
    #[arg(
        long,
        value_name = "SECONDS",
        requires = "out",
        conflicts_with = "realtime",
        allow_hyphen_values = true
    )]
    checkpoint: Option<f64>,
    /// Go on from DIR/checkpoint.mbs, or from FILE, with the settings of its run; the results are those of a run in one go, to the
    /// last bit.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, conflicts_with_all = ["restart", "realtime"])]
    resume: Option<Option<PathBuf>>,
    /// Throw away the checkpoint that an earlier start left in the directory.
    #[arg(long, requires = "out")]
    restart: bool,
}

/// A file that is not there yet: where it can be made a checkpoint can.
const TRIAL: &str = "checkpoint.mbs.part";

/// What a run goes on from, and how it is kept.
#[derive(Debug, Default)]
pub(crate) struct Kept {
    pub(crate) from: Option<Checkpoint>,
    pub(crate) keeping: Option<Keeping>,
    out: Option<PathBuf>,
}

impl Arguments {
    /// Finds out, and reads the checkpoint; else the refusal.
    pub(crate) fn begin(&self, out: Option<&Path>) -> Result<Kept, String> {
        if let Some(every) = self.checkpoint
            && !(every > 0.0 && every.is_finite())
        {
            return Err(format!(
                "error: the time between checkpoints must be positive and finite, but is {every}\nhint: give simulated seconds, such as --checkpoint 1"
            ));
        }
        let path = match (&self.resume, out) {
            (None, _) => return self.anew(out),
            (Some(Some(file)), _) => file.clone(),
            (Some(None), Some(out)) => out.join(CHECKPOINT),
            (Some(None), None) => {
                return Err("error: there is no directory to go on in\nhint: give --out DIR, or --resume=FILE".to_owned());
            }
        };
        if let Some(out) = out.filter(|out| is_another(&out.join(CHECKPOINT), &path)) {
            return Err(unfinished(out, "give another directory with --out, or remove the file"));
        }
        let from = Checkpoint::open(&path).map_err(|error| refusal(&path, &error))?;
        let stored = if from.every() > 0.0 { from.every() } else { f64::INFINITY };
        let keeping = out.map(|out| keeping(out, self.checkpoint.unwrap_or(stored))).transpose()?;
        Ok(Kept { from: Some(from), keeping, out: out.map(Path::to_owned) })
    }

    /// A run from its start.
    fn anew(&self, out: Option<&Path>) -> Result<Kept, String> {
        let Some(out) = out else { return Ok(Kept::default()) };
        if out.join(CHECKPOINT).exists() && !self.restart {
            return Err(unfinished(out, "go on with --resume, or begin anew with --restart"));
        }
        let keeping = self.checkpoint.map(|every| keeping(out, every)).transpose()?;
        Ok(Kept { from: None, keeping, out: Some(out.to_owned()) })
    }
}

/// Keeps a run in a directory; else the refusal.
fn keeping(out: &Path, every: f64) -> Result<Keeping, String> {
    Keeping::new(out, every).map_err(|error| match error {
        CheckpointError::Io(error) => files::unwritable(out, &error),
        error => said(&error),
    })
}

/// Is there a file, and not under the other name?
fn is_another(file: &Path, other: &Path) -> bool {
    file.exists() && file.canonicalize().ok() != other.canonicalize().ok()
}

/// The refusal of a directory where a run has not ended.
fn unfinished(out: &Path, hint: &str) -> String {
    let at = Checkpoint::open(&out.join(CHECKPOINT));
    let at = at.map(|c| format!(", at t = {} s", words::time(c.time()))).unwrap_or_default();
    let out = out.display();
    format!("error: `{out}` has the checkpoint of a run that has not ended{at}\nhint: {hint}")
}

impl Kept {
    /// What is given, and the settings of the checkpoint where nothing is; else the refusal.
    pub(crate) fn overrides(&self, given: Overrides) -> Result<Overrides, String> {
        let Some(from) = &self.from else { return Ok(given) };
        from.overrides(&given).map_err(|error| said(&error))
    }

    /// The settings, where they are those of the checkpoint; else the refusal.
    pub(crate) fn settle(&self, settings: Settings) -> Result<Settings, String> {
        let Some(from) = &self.from else { return Ok(settings) };
        from.settle(settings).map_err(|error| said(&error))
    }

    /// The file to try the place of the results by: one that nothing is lost with.
    pub(crate) fn trial(&self) -> &'static str {
        if self.keeping.is_some() { TRIAL } else { "run.csv" }
    }

    /// Nothing stands in the way: what an earlier start has left goes, and what the trial has.
    pub(crate) fn clear(&self) {
        if let (Some(_), Some(out)) = (&self.keeping, &self.out) {
            let _ = std::fs::remove_file(out.join(TRIAL));
        }
        if let (None, Some(out)) = (&self.from, &self.out) {
            // What is not there need not go.
            let _ = std::fs::remove_file(out.join(CHECKPOINT));
        }
    }

    /// The run has ended and its results are written: there is nothing to go on with. Tells what could not be written on the way.
    pub(crate) fn end(&self) {
        let Some(keeping) = &self.keeping else { return };
        if let Some(error) = keeping.failure() {
            let path = keeping.path();
            eprintln!(
                "warning: the last checkpoint could not be written: {}",
                files::unwritable_file(&path, error)
            );
        }
        let _ = std::fs::remove_file(keeping.path());
    }
}

/// A refusal of a checkpoint.
pub(crate) fn said(error: &CheckpointError) -> String {
    format!("error: {error}\nhint: {}", error.hint())
}

fn refusal(path: &Path, error: &CheckpointError) -> String {
    let path = path.display();
    match error {
        CheckpointError::Io(error) if error.kind() == ErrorKind::NotFound => format!(
            "error: there is no checkpoint `{path}`\nhint: a run has one if it is begun with --checkpoint SECONDS, and until it has ended"
        ),
        error => format!("error: `{path}`: {error}\nhint: {}", error.hint()),
    }
}
