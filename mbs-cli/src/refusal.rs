//! Refusal of a command that does nothing: text for people, and with `--json` an object for programs.

use crate::say::{say, warn};
use crate::status::{REFUSED, STOPPED};
use core::fmt::Display;
use mbs::folder::{FolderError, WriteError};
use mbs::scene_file::{Place, ReadError};
use mbs::{CheckpointError, INTERRUPTED, PrecisionError, SettingsError};
use serde_json::{Value, json};
use std::path::Path;
use std::process::ExitCode;

/// Reason why a command does nothing, or gives no result. Codes are fixed words, listed in docs/CONTRACT.md.
#[derive(Debug)]
pub(crate) struct Refusal {
    code: &'static str,
    /// Exit status of the program.
    status: u8,
    message: String,
    hint: String,
    /// File and place in it, if there is one.
    place: Option<Box<(String, Place)>>,
}

impl Refusal {
    pub(crate) fn new(code: &'static str, message: impl Display, hint: impl Display) -> Self {
        let (message, hint) = (message.to_string(), hint.to_string());
        Self { code, status: REFUSED, message, hint, place: None }
    }

    /// Adds a place in a file to the refusal.
    pub(crate) fn at(self, file: &str, place: Place) -> Self {
        Self { place: Some(Box::new((file.to_owned(), place))), ..self }
    }

    /// Refusal of a file's text.
    pub(crate) fn read(code: &'static str, error: &ReadError) -> Self {
        Self::new(code, error.fault(), error.hint()).at(error.file(), error.place().clone())
    }

    /// Refusal of a scene's text in the precision of a run.
    pub(crate) fn scene(error: &PrecisionError) -> Self {
        match error {
            PrecisionError::Read(error) => Self::read("scene-refused", error),
            other => Self::new("precision-not-built", other, other.hint()),
        }
    }

    /// Refusal of settings without a place in the scene.
    pub(crate) fn settings(error: &SettingsError) -> Self {
        Self::new("settings-refused", error, error.hint())
    }

    /// Refusal of a directory for results.
    pub(crate) fn folder(out: &Path, error: &FolderError) -> Self {
        let out = out.display();
        match error {
            FolderError::Busy(_) => {
                Self::new("out-busy", format!("`{out}`: {error}"), error.hint())
            }
            FolderError::Io(io) => {
                let message = format!("cannot write to `{out}`: {}", crate::say::plain(io));
                Self::new("out-unwritable", message, error.hint())
            }
            other => {
                let message = format!("cannot write to `{out}`: {other}");
                Self::new("out-unwritable", message, error.hint())
            }
        }
    }

    /// Refusal of a checkpoint.
    pub(crate) fn checkpoint(error: &CheckpointError) -> Self {
        Self::new("checkpoint-refused", error, error.hint())
    }

    /// Refusal of results that were computed and could not be written.
    pub(crate) fn lost(error: &WriteError) -> Self {
        Self::unwritable(error).stopped()
    }

    /// Returns the result of writing. If writing failed, reports this, and sets the status to that of a run that stopped.
    pub(crate) fn unless_lost<W>(
        written: Result<W, WriteError>,
        status: &mut ExitCode,
    ) -> Option<W> {
        let lost = |error: &WriteError| {
            Self::lost(error).warn();
            *status = ExitCode::from(STOPPED);
        };
        written.inspect_err(lost).ok()
    }

    /// Refusal of a file that could not be written.
    pub(crate) fn unwritable(error: &WriteError) -> Self {
        let hint =
            "make room, or give a place that can be written; what was there before is as it was";
        Self::new("out-unwritable", error, hint)
    }

    /// Marks the refusal as one of a command that had begun: its exit status is that of a run that stopped.
    pub(crate) fn stopped(self) -> Self {
        Self { status: STOPPED, ..self }
    }

    /// Refusal that names the interrupted command, and the results so far.
    pub(crate) fn interrupted(message: impl Display, hint: &str) -> Self {
        Self::new(INTERRUPTED, message, hint).stopped()
    }

    /// Prints the refusal on standard error, and with `--json` as an object on standard output.
    pub(crate) fn report(&self) -> ExitCode {
        self.warn();
        self.object()
    }

    /// Prints the refusal on standard error.
    pub(crate) fn warn(&self) {
        warn(&self.text());
    }

    /// Returns the text of the refusal for people.
    pub(crate) fn text(&self) -> String {
        let Self { message, hint, .. } = self;
        match &self.place {
            Some(at) => at.1.render(&at.0, message, hint),
            None if hint.is_empty() => format!("error: {message}"),
            None => format!("error: {message}\nhint: {hint}"),
        }
    }

    /// Returns the refusal as an object of JSON for programs.
    pub(crate) fn error(&self) -> Value {
        let place = self.place.as_deref();
        json!({
            "code": self.code,
            "message": self.message,
            "file": place.map(|(file, _)| file),
            "line": place.map(|(_, place)| place.line),
            "column": place.map(|(_, place)| place.column),
            "hint": self.hint,
        })
    }

    /// Prints the object if JSON is requested. Returns the exit status.
    fn object(&self) -> ExitCode {
        let status = ExitCode::from(self.status);
        if !wants_json() {
            return status;
        }
        say(&json!({ "error": self.error() }).to_string(), status)
    }
}

/// True if one JSON object is requested. Refused arguments are not parsed, so the words themselves are searched.
fn wants_json() -> bool {
    crate::line::words().take_while(|word| word != "--").any(|word| word == "--json")
}

impl From<&PrecisionError> for Refusal {
    fn from(error: &PrecisionError) -> Self {
        Self::scene(error)
    }
}

/// Reports a refusal of the arguments, whose text is on standard error already.
pub(crate) fn usage(message: &str, hint: &str) -> ExitCode {
    Refusal::new("usage", message, hint).object()
}
