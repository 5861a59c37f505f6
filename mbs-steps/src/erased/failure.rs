//! Error of a simulation that could not be created or that stopped.

use super::error::{Error, PathError, SceneError, UnknownName};
use crate::checkpoint::CheckpointError;
use crate::names::Names;
use crate::precision::PrecisionError;
use crate::realtime::PacingError;
use crate::settings::SettingsError;
use crate::stop::StopError;
use crate::tree::TreeError;
use core::fmt::{self, Display, Formatter};
use mbs_core::step::InputError;
use mbs_parallel::ensemble::EnsembleError;
use mbs_scene::{Place, ReadError, WriteError};

/// Error of a simulation or a study that could not be created or that stopped.
///
/// Programs compare the [`code`](Error::code), which is part of the contract (docs/CONTRACT.md). [`cause`](Self::cause) returns the typed
/// error that caused this one.
#[derive(Debug)]
pub struct SimulationError(Box<Parts>);

#[derive(Debug)]
struct Parts {
    code: &'static str,
    message: String,
    time: Option<f64>,
    joint: Option<String>,
    body: Option<String>,
    hint: String,
    place: Option<Place>,
    cause: Option<Box<dyn core::error::Error + Send + Sync>>,
}

impl SimulationError {
    /// Creates a user-defined error, with which an [`Observer`](crate::Observer) stops a run: its code, message and hint.
    ///
    /// ```
    /// use mbs::{Error, SimulationError};
    /// let error = SimulationError::new("too-hot", "the motor is at 140 °C", "");
    /// assert_eq!((error.code(), error.hint()), ("too-hot", None));
    /// ```
    #[must_use]
    pub fn new(code: &'static str, message: impl Display, hint: impl Display) -> Self {
        let (message, hint) = (message.to_string(), hint.to_string());
        let (time, joint, body, place, cause) = (None, None, None, None, None);
        Self(Box::new(Parts { code, message, time, joint, body, hint, place, cause }))
    }

    /// Adds the typed error that caused this one.
    #[must_use]
    pub fn with_cause(mut self, cause: impl core::error::Error + Send + Sync + 'static) -> Self {
        self.0.cause = Some(Box::new(cause));
        self
    }

    /// Converts an error of the public API.
    fn of(error: impl Error + Send + Sync + 'static) -> Self {
        let mut found = Self::new(error.code(), &error, error.hint().unwrap_or_default());
        let owned = |name: Option<&str>| name.map(str::to_owned);
        (found.0.joint, found.0.body) = (owned(error.joint()), owned(error.body()));
        (found.0.time, found.0.place) = (error.time(), error.place());
        found.with_cause(error)
    }

    /// Sets the name of the joint that the error concerns.
    pub fn about(mut self, joint: Option<String>) -> Self {
        self.0.joint = joint;
        self
    }

    /// Creates the error of a stop at a time [s], with the names of the scene.
    #[must_use]
    pub fn stopped(error: StopError, time: f64, names: &Names) -> Self {
        let report = error.report(time, names);
        let mut found = Self::new(error.code(), report.message, report.hint);
        (found.0.time, found.0.joint, found.0.body) = (Some(time), report.joint, report.body);
        found.with_cause(error)
    }

    /// Creates the error of a checkpoint from which a run cannot be resumed.
    #[must_use]
    pub fn not_resumed(error: CheckpointError) -> Self {
        Self::new("checkpoint-refused", &error, error.hint()).with_cause(error)
    }

    /// Message of the error, without its place, time and hint.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Replaces the hint of the error.
    #[must_use]
    pub fn with_hint(mut self, hint: String) -> Self {
        self.0.hint = hint;
        self
    }

    /// Converts the error into a reason that stops a run.
    pub fn into_stop(self) -> StopError {
        match self.cause::<StopError>() {
            Some(stop) => stop.clone(),
            None => {
                let Parts { code, message, hint, .. } = *self.0;
                StopError::Observer { code, message: message.into(), hint: hint.into() }
            }
        }
    }

    /// The typed error that caused this one, for example `error.cause::<StopError>()`.
    #[must_use]
    pub fn cause<E: core::error::Error + 'static>(&self) -> Option<&E> {
        self.0.cause.as_ref()?.downcast_ref()
    }
}

impl Error for SimulationError {
    fn code(&self) -> &'static str {
        self.0.code
    }
    fn time(&self) -> Option<f64> {
        self.0.time
    }
    fn joint(&self) -> Option<&str> {
        self.0.joint.as_deref()
    }
    fn body(&self) -> Option<&str> {
        self.0.body.as_deref()
    }
    fn hint(&self) -> Option<String> {
        Some(self.0.hint.clone()).filter(|hint| !hint.is_empty())
    }
    fn place(&self) -> Option<Place> {
        self.0.place.clone()
    }
}

impl Display for SimulationError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Parts { message, time, joint, body, hint, place, .. } = &*self.0;
        // The message of an error in a file already begins with the place.
        if let Some(place) = place.as_ref().filter(|_| self.cause::<ReadError>().is_none()) {
            write!(f, "{}:{}: ", place.line, place.column)?;
        }
        f.write_str(message)?;
        if let Some(joint) = joint {
            write!(f, ", joint `{joint}`")?;
        }
        if let Some(body) = body {
            write!(f, ", body `{body}`")?;
        }
        if let Some(time) = time {
            write!(f, ", at {} s", mbs_scene::format::significant(*time))?;
        }
        if hint.is_empty() { Ok(()) } else { write!(f, "\nhint: {hint}") }
    }
}

impl core::error::Error for SimulationError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        self.0.cause.as_ref().map(|cause| &**cause as _)
    }
}

impl From<PrecisionError> for SimulationError {
    fn from(error: PrecisionError) -> Self {
        match error {
            PrecisionError::Read(error) => Self::of(*error),
            other => Self::new("precision-not-built", &other, other.hint()).with_cause(other),
        }
    }
}

impl From<SettingsError> for SimulationError {
    fn from(error: SettingsError) -> Self {
        Self::new("settings-refused", &error, error.hint()).with_cause(error)
    }
}

impl From<PacingError> for SimulationError {
    fn from(error: PacingError) -> Self {
        Self::new("pacing-refused", &error, error.hint()).with_cause(error)
    }
}

impl From<CheckpointError> for SimulationError {
    fn from(error: CheckpointError) -> Self {
        let hint = match &error {
            CheckpointError::Settings(error) => error.hint(),
            _ => "give what `save` gave, to a simulation of the same mechanism, method and version of mbs".to_owned(),
        };
        Self::new("checkpoint-refused", &error, hint).with_cause(error)
    }
}

macro_rules! from {
    ($($error:ty),* $(,)?) => {$(
        impl From<$error> for SimulationError {
            fn from(error: $error) -> Self {
                Self::of(error)
            }
        }
    )*};
}

from!(SceneError, TreeError, ReadError, WriteError, PathError, UnknownName);

impl From<EnsembleError> for SimulationError {
    fn from(error: EnsembleError) -> Self {
        Self::new("settings-refused", error, "write a smaller number").with_cause(error)
    }
}

impl From<InputError> for SimulationError {
    fn from(error: InputError) -> Self {
        let hint = "inputs are declared in the mechanism: a signal, or the motion of a guide, of kind input; values are finite";
        Self::new("input-refused", error, hint).with_cause(error)
    }
}
