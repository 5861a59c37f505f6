//! `mbs` with all precisions: built once, run on scenes, its results read back.

pub(crate) mod columns;
pub(crate) mod outcome;

use outcome::Outcome;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use xtask::command::built;
use xtask::process;

/// How often a run that may take too long is looked at.
const PAUSE: Duration = Duration::from_millis(2);

/// The command `mbs`, with all precisions.
#[derive(Debug)]
pub(crate) struct Mbs {
    path: PathBuf,
}

impl Mbs {
    /// Builds it.
    ///
    /// # Errors
    ///
    /// What cargo came to.
    pub(crate) fn build() -> Result<Self, String> {
        Ok(Self { path: built()? })
    }

    /// Runs a scene; with a folder, the run's files are left there; after `limit` it is ended.
    ///
    /// # Errors
    ///
    /// The command, and why nothing can be read from it.
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
        let line = process::line(&command);
        let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = child.spawn().map_err(|e| format!("cannot start `{line}`: {e}"))?;
        finish(child, limit).map_err(|why| format!("`{line}`: {why}"))
    }
}

impl Mbs {
    /// Compares the methods on a scene, with about so much work [s] or the usual, and leaves the files in a folder.
    ///
    /// # Errors
    ///
    /// The command, and what it came to.
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

/// Waits for a run and reads what it came to.
fn finish(mut child: Child, limit: Option<Duration>) -> Result<Outcome, String> {
    let (stdout, stderr) = (drain(child.stdout.take()), drain(child.stderr.take()));
    let start = Instant::now();
    while let Some(limit) = limit {
        if child.try_wait().map_err(|e| e.to_string())?.is_some() {
            break;
        }
        if start.elapsed() > limit {
            // It may have ended by itself meanwhile.
            let _ = child.kill();
            child.wait().map_err(|e| e.to_string())?;
            return Ok(Outcome::TooLong(limit.as_secs_f64()));
        }
        thread::sleep(PAUSE);
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    let text = |reader: thread::JoinHandle<Vec<u8>>| reader.join().unwrap_or_default();
    outcome::read(status.code(), &text(stdout), &text(stderr))
}

/// Reads a stream to its end, so that the child never waits for us.
fn drain(stream: Option<impl Read + Send + 'static>) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut stream) = stream {
            // What has come until then is judged.
            let _ = stream.read_to_end(&mut bytes);
        }
        bytes
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str) -> Child {
        let mut command = Command::new("sh");
        command.args(["-c", script]).stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().unwrap()
    }

    #[cfg(unix)]
    #[test]
    fn a_run_that_takes_too_long_is_ended() {
        let limit = Duration::from_millis(50);
        assert_eq!(finish(shell("exec sleep 20"), Some(limit)), Ok(Outcome::TooLong(0.05)));
        let refused = Outcome::Refused("no such scene".into());
        let script = "echo 'error: no such scene' >&2; exit 1";
        assert_eq!(finish(shell(script), Some(Duration::from_secs(20))), Ok(refused));
    }
}
