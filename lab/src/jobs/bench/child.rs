//! The measuring program: started, waited for, ended where it takes too long.

use serde_json::Value;
use std::io::Read;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};
use xtask::process;

/// How often a run is looked at.
const PAUSE: Duration = Duration::from_millis(5);

/// The program, and what every run of it is told.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) path: PathBuf,
    pub(crate) threads: String,
    pub(crate) seconds: &'static str,
}

impl Program {
    /// The lines that it prints.
    ///
    /// # Errors
    ///
    /// What it refuses, or that it has taken longer than `limit`.
    pub(crate) fn run(&self, places: &[&str], limit: Duration) -> Result<Vec<Value>, String> {
        let mut command = Command::new(&self.path);
        command.arg("bench").args(places).args([
            "--threads",
            &self.threads,
            "--seconds",
            self.seconds,
        ]);
        command.current_dir(process::root());
        lines(&finish(&mut command, limit)?)
    }
}

/// Waits for a command and gives its output; after `limit` it is ended.
///
/// # Errors
///
/// What it says where it fails, or that it took too long.
pub(crate) fn finish(command: &mut Command, limit: Duration) -> Result<String, String> {
    let line = process::line(command);
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().map_err(|e| format!("cannot start `{line}`: {e}"))?;
    let (out, errors) = (drain(child.stdout.take()), drain(child.stderr.take()));
    let start = Instant::now();
    while child.try_wait().map_err(|e| e.to_string())?.is_none() {
        if start.elapsed() > limit {
            // It may have ended by itself meanwhile.
            let _ = child.kill();
            child.wait().map_err(|e| e.to_string())?;
            return Err(format!("took more than {} s to prepare and to step", limit.as_secs_f64()));
        }
        thread::sleep(PAUSE);
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    let [out, errors] = [out, errors].map(|reader| reader.join().unwrap_or_default());
    if status.success() { Ok(out) } else { Err(format!("`{line}`: {status}: {}", errors.trim())) }
}

/// Reads a stream to its end, so that the child never waits for us.
fn drain(stream: Option<impl Read + Send + 'static>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut stream) = stream {
            // What has come until then is judged.
            let _ = stream.read_to_end(&mut bytes);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Lines of JSON.
fn lines(text: &str) -> Result<Vec<Value>, String> {
    let value = |line: &str| serde_json::from_str(line).map_err(|e| format!("`{line}`: {e}"));
    text.lines().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(script: &str, limit: Duration) -> Result<String, String> {
        finish(Command::new("sh").args(["-c", script]), limit)
    }

    #[cfg(unix)]
    #[test]
    fn a_run_is_read_refused_or_ended() {
        let long = Duration::from_secs(20);
        let read = lines(&shell("echo '{\"kind\": \"fork\"}'", long).unwrap()).unwrap();
        assert_eq!(read, [serde_json::json!({ "kind": "fork" })]);
        assert!(shell("echo no >&2; exit 1", long).unwrap_err().ends_with(": no"));
        let ended = shell("exec sleep 20", Duration::from_millis(30)).unwrap_err();
        assert!(ended.contains("took more than 0.03 s"));
        assert!(lines("no json").is_err());
    }
}
