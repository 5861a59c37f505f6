//! The command `mbs` with all precisions: it is built once and run on scenes, and its results are read.

pub(crate) mod columns;
pub(crate) mod outcome;

use outcome::Outcome;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;
use xtask::child::watched;
use xtask::command::built;
use xtask::process;

/// The command `mbs`, with all precisions.
#[derive(Debug)]
pub(crate) struct Mbs {
    path: PathBuf,
}

impl Mbs {
    /// Builds the command.
    ///
    /// # Errors
    ///
    /// The message of cargo.
    pub(crate) fn build() -> Result<Self, String> {
        Ok(Self { path: built()? })
    }

    /// Runs a scene by `mbs`. With a folder, the files of the run are written to it. The run is ended after `limit`.
    ///
    /// # Errors
    ///
    /// The command, and the reason why its output cannot be read.
    pub(crate) fn run(
        &self,
        scene: &Path,
        arguments: &[String],
        out: Option<&Path>,
        limit: Option<Duration>,
    ) -> Result<Outcome, String> {
        let mut command = Command::new(&self.path);
        command.args(["run", "--json"]).args(arguments).arg(scene);
        if let Some(out) = out {
            command.arg("--out").arg(out);
        }
        let Some(output) = watched(&mut command, limit)? else {
            return Ok(Outcome::TooLong(limit.unwrap_or_default().as_secs_f64()));
        };
        outcome::read(output.status.code(), &output.stdout, &output.stderr)
            .map_err(|why| format!("`{}`: {why}", process::line(&command)))
    }

    /// Compares the methods on a scene, with approximately the given time of all runs [s] or the default one. The files are written to a
    /// folder.
    ///
    /// # Errors
    ///
    /// The command and its exit status, if it fails.
    pub(crate) fn compare(
        &self,
        scene: &Path,
        out: &Path,
        budget: Option<&str>,
    ) -> Result<(), String> {
        let mut command = Command::new(&self.path);
        command.args(["compare", "--restart"]).arg("--out").arg(out).arg(scene);
        if let Some(budget) = budget {
            command.args(["--budget", budget]);
        }
        if let Some(commit) = process::commit() {
            command.env("MBS_COMMIT", commit);
        }
        process::run(&mut command)
    }
}

/// The path of a scene of this repository.
pub(crate) fn scene(name: &str) -> PathBuf {
    process::root().join("scenes").join(format!("{name}.toml"))
}
