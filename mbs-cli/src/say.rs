//! Output of texts on standard output and on standard error, and the exit status when it fails.

use crate::status::STOPPED;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Writes a result to standard output, and returns the exit status of the command. If writing fails, the result goes to standard error, so
/// that it is not lost, and the status reports the failure. A closed pipe is no error of the command.
pub(crate) fn say(text: &str, status: ExitCode) -> ExitCode {
    let text = text.trim_end();
    match out(text) {
        Ok(()) => status,
        Err(why) => {
            warn(&format!("{why}\n{text}"));
            ExitCode::from(STOPPED)
        }
    }
}

/// Writes text that can be made again to standard output. Returns a message if this fails.
pub(crate) fn out(text: &str) -> Result<(), String> {
    if text.is_empty() {
        return Ok(());
    }
    let mut sink = std::io::stdout().lock();
    let text = text.trim_end();
    // flush reports an error that would be ignored at the end of the process
    match writeln!(sink, "{text}").and_then(|()| sink.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!(
            "error: cannot write to standard output: {}\nhint: make room, or give another place",
            plain(&error)
        )),
        _ => Ok(()),
    }
}

/// Writes to standard error. An error is ignored, since no stream is left to report it.
pub(crate) fn warn(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// The system's error message without the number of the error.
pub(crate) fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}
