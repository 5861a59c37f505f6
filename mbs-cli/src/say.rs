//! Writing of texts to standard output and to standard error, with the exit status where it fails.

use crate::status::STOPPED;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Writes a result to standard output, and gives the exit status: that of the command, unless the result could not be written. Then it goes
/// to standard error, so that it is not lost. A reader that has gone away is no error of the command.
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

/// Writes what can be made again to standard output; why not.
pub(crate) fn out(text: &str) -> Result<(), String> {
    if text.is_empty() {
        return Ok(());
    }
    let mut sink = std::io::stdout().lock();
    let text = text.trim_end();
    // what is left in a buffer is lost without a word at the end
    match writeln!(sink, "{text}").and_then(|()| sink.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(format!(
            "error: cannot write to standard output: {}\nhint: make room, or give another place",
            plain(&error)
        )),
        _ => Ok(()),
    }
}

/// Writes to standard error; where that is closed or full there is no reader left.
pub(crate) fn warn(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// The system's words without the number of the error.
pub(crate) fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    text.split(" (os error").next().unwrap_or_default().to_lowercase()
}
