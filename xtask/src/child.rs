//! Programs that are started and waited for, and ended where they take too long.

use crate::process;
use std::io::Read;
use std::process::{Command, Output, Stdio};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How often a program that may take too long is looked at.
const PAUSE: Duration = Duration::from_millis(2);

/// Waits for a command; `None` where it was ended after `limit`.
///
/// # Errors
///
/// Why it cannot be started or waited for.
pub fn watched(command: &mut Command, limit: Option<Duration>) -> Result<Option<Output>, String> {
    let line = process::line(command);
    let failed = |e: std::io::Error| format!("`{line}`: {e}");
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = child.spawn().map_err(failed)?;
    let (out, errors) = (drain(child.stdout.take()), drain(child.stderr.take()));
    let start = Instant::now();
    while let Some(limit) = limit {
        if child.try_wait().map_err(failed)?.is_some() {
            break;
        }
        if start.elapsed() > limit {
            // It may have ended by itself meanwhile.
            let _ = child.kill();
            child.wait().map_err(failed)?;
            return Ok(None);
        }
        thread::sleep(PAUSE);
    }
    let status = child.wait().map_err(failed)?;
    let [stdout, stderr] = [out, errors].map(|reader| reader.join().unwrap_or_default());
    Ok(Some(Output { status, stdout, stderr }))
}

/// What a command prints.
///
/// # Errors
///
/// What it says where it fails, or that it has taken longer than `limit`.
pub fn printed(command: &mut Command, limit: Duration) -> Result<String, String> {
    let Some(Output { status, stdout, stderr }) = watched(command, Some(limit))? else {
        return Err(format!("took more than {} s to prepare and to step", limit.as_secs_f64()));
    };
    if status.success() {
        return Ok(String::from_utf8_lossy(&stdout).into_owned());
    }
    let errors = String::from_utf8_lossy(&stderr);
    Err(format!("`{}`: {status}: {}", process::line(command), errors.trim()))
}

/// Reads a stream to its end, so that the child never waits for us.
fn drain(stream: Option<impl Read + Send + 'static>) -> JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut stream) = stream {
            // What has come until then is judged.
            let _ = stream.read_to_end(&mut bytes);
        }
        bytes
    })
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_read_refused_or_ended() {
        let shell = |script: &str, ms: u64| {
            printed(Command::new("sh").args(["-c", script]), Duration::from_millis(ms))
        };
        assert_eq!(shell("echo line", 20_000), Ok("line\n".to_owned()));
        assert!(shell("echo no >&2; exit 1", 20_000).unwrap_err().ends_with(": no"));
        assert!(shell("exec sleep 20", 30).unwrap_err().contains("took more than 0.03 s"));
    }
}
