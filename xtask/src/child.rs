//! Child processes: a job starts them, waits for them, and ends them after a time limit.

use crate::process;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Output, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Time between two queries whether a program with a time limit has ended.
const PAUSE: Duration = Duration::from_millis(2);
/// Time without output after which a program is queried whether it has ended. Chosen, not tuned.
const SILENCE: Duration = Duration::from_secs(1);

/// Waits for a command; `None` if it was ended after `limit`.
///
/// # Errors
///
/// The reason why it cannot be started or waited for.
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
            // an error is ignored: the child may have ended by itself
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

/// Returns the text that a command prints.
///
/// # Errors
///
/// The command's error output if it fails, or that it took longer than `limit`.
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

/// Runs a command and shows its standard output, line by line; each line is also given to `read`.
///
/// # Errors
///
/// The command and its exit status, if it fails.
#[allow(clippy::print_stdout, reason = "the output is the command's")]
pub(crate) fn shown(command: &mut Command, mut read: impl FnMut(&str)) -> Result<(), String> {
    let line = process::line(command);
    let failed = |e: std::io::Error| format!("`{line}`: {e}");
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = child.spawn().map_err(failed)?;
    let lines = lines(child.stdout.take());
    while let Some(line) = next(&lines, &mut child) {
        println!("{line}");
        read(&line);
    }
    let status = child.wait().map_err(failed)?;
    if status.success() { Ok(()) } else { Err(format!("`{line}`: {status}")) }
}

/// The lines of a stream, which another thread reads as they come.
fn lines(stream: Option<impl Read + Send + 'static>) -> Receiver<String> {
    let (sender, lines) = mpsc::channel();
    thread::spawn(move || {
        let mut stream = stream.map(BufReader::new);
        let mut bytes = Vec::new();
        while let Some(Ok(1..)) = stream.as_mut().map(|s| s.read_until(b'\n', &mut bytes)) {
            let text = String::from_utf8_lossy(&bytes).trim_end().to_owned();
            if sender.send(text).is_err() {
                break;
            }
            bytes.clear();
        }
    });
    lines
}

/// The next line; `None` at the end, or when the child has ended and is silent. Another program that the child started may keep the stream
/// open.
fn next(lines: &Receiver<String>, child: &mut Child) -> Option<String> {
    loop {
        match lines.recv_timeout(SILENCE) {
            Ok(line) => return Some(line),
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) if matches!(child.try_wait(), Ok(None)) => {}
            Err(RecvTimeoutError::Timeout) => return lines.try_recv().ok(),
        }
    }
}

/// Reads a stream to its end, so that the child is never blocked by a full pipe.
fn drain(stream: Option<impl Read + Send + 'static>) -> JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut stream) = stream {
            // an error ends the output: the text so far is used
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

    #[test]
    fn lines_are_read_as_they_come_and_what_is_left_behind_is_not_waited_for() {
        let start = Instant::now();
        let mut lines = Vec::new();
        let script = "echo one; printf two; sleep 60 & exit 3";
        let ended =
            shown(Command::new("sh").args(["-c", script]), |line| lines.push(line.to_owned()));
        assert!(ended.unwrap_err().ends_with("exit status: 3"));
        assert_eq!(lines, ["one"]);
        assert!(start.elapsed() < Duration::from_secs(30));
        assert!(shown(&mut Command::new("true"), |_| {}).is_ok());
    }
}
