//! Errors of the libraries as exceptions of Python.

use mbs::scene_file::{Place, ReadError};
use mbs::{Error, SettingsError, SimulationError, StopError, UnknownName};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Fields of which an exception is made.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fields {
    pub(crate) code: String,
    pub(crate) message: String,
    pub(crate) hint: String,
    pub(crate) time: Option<f64>,
    pub(crate) joint: Option<String>,
    pub(crate) body: Option<String>,
    pub(crate) argument: Option<String>,
    pub(crate) gap: Option<f64>,
    pub(crate) place: Option<(String, Place)>,
}

/// The classes of exceptions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Class {
    Base,
    Scene,
    Start,
    Stop,
    Usage,
    Busy,
}

impl Class {
    fn name(self) -> &'static str {
        match self {
            Self::Base => "MbsError",
            Self::Scene => "SceneError",
            Self::Start => "StartError",
            Self::Stop => "StopError",
            Self::Usage => "UsageError",
            Self::Busy => "BusyError",
        }
    }
}

/// Makes an exception of a class from its fields.
pub(crate) fn exception(py: Python<'_>, class: Class, fields: &Fields) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let class = py.import("multibody.errors")?.getattr(class.name())?;
        let words = PyDict::new(py);
        words.set_item("code", &fields.code)?;
        words.set_item("time", fields.time)?;
        words.set_item("joint", &fields.joint)?;
        words.set_item("body", &fields.body)?;
        words.set_item("argument", &fields.argument)?;
        words.set_item("gap", fields.gap)?;
        words.set_item("hint", Some(&fields.hint).filter(|hint| !hint.is_empty()))?;
        if let Some((file, place)) = &fields.place {
            words.set_item("file", file)?;
            words.set_item("line", place.line)?;
            words.set_item("column", place.column)?;
            words.set_item("text", &place.text)?;
        }
        Ok(PyErr::from_value(class.call((&fields.message,), Some(&words))?))
    };
    made().unwrap_or_else(|error| error)
}

/// An argument that is refused.
pub(crate) fn usage(
    py: Python<'_>,
    code: &str,
    message: &str,
    hint: &str,
    argument: &str,
) -> PyErr {
    let fields = Fields {
        code: code.to_owned(),
        message: message.to_owned(),
        hint: hint.to_owned(),
        argument: Some(argument.to_owned()),
        ..Fields::default()
    };
    exception(py, Class::Usage, &fields)
}

/// A name that is not there, of an argument; the hint proposes the nearest one. `kinds` are what is named, one of them and several.
pub(crate) fn unknown_name<S: AsRef<str>>(
    py: Python<'_>,
    [kind, kinds]: [&str; 2],
    (argument, name): (&str, &str),
    known: &[S],
) -> PyErr {
    let hint = mbs::scene_file::nearest_name(name, known, kinds);
    usage(py, "unknown-name", &format!("there is no {kind} `{name}`"), &hint, argument)
}

/// Codes of texts that are refused.
const OF_TEXTS: [&str; 6] = [
    "scene-refused",
    "model-refused",
    "sweep-refused",
    "set-refused",
    "file-unreadable",
    "too-large",
];

/// An error of the front door; `class` is that of what stops a start or a step.
pub(crate) fn raised(py: Python<'_>, error: &SimulationError, class: Class) -> PyErr {
    exception(py, class_of(error, class), &fields(error))
}

/// An error of the front door about the first argument that has its code; those of steps and starts are of `class`.
pub(crate) fn refused(
    py: Python<'_>,
    error: &SimulationError,
    class: Class,
    arguments: &[(&str, &str)],
) -> PyErr {
    let found = arguments.iter().find(|(code, _)| *code == error.code());
    let mut fields = fields(error);
    fields.argument = found.map(|(_, argument)| (*argument).to_owned()).or(fields.argument);
    exception(py, class_of(error, class), &fields)
}

/// The class of an error.
pub(crate) fn class_of(error: &SimulationError, class: Class) -> Class {
    let code = error.code();
    if OF_TEXTS.contains(&code) {
        return Class::Scene;
    }
    let is_stop = error.cause::<StopError>().is_some()
        || ["no-accelerations", "open-loops", "no-tree"].contains(&code);
    if is_stop { class } else { Class::Usage }
}

/// The fields of an error of the front door.
pub(crate) fn fields(error: &SimulationError) -> Fields {
    let read = error.cause::<ReadError>();
    let gap = error.cause::<StopError>().and_then(StopError::gap);
    let file = || read.map(|read| read.file().to_owned()).unwrap_or_default();
    let of_settings = error.cause::<SettingsError>().and_then(SettingsError::key);
    let of_names = error.cause::<UnknownName>().map(|unknown| format!("{}s", unknown.kind()));
    let text = error.to_string();
    let message = text.split("\nhint: ").next().unwrap_or_default();
    Fields {
        code: error.code().to_owned(),
        message: message.to_owned(),
        hint: error.hint().unwrap_or_default(),
        time: error.time(),
        joint: error.joint().map(str::to_owned),
        body: error.body().map(str::to_owned),
        place: error.place().map(|place| (file(), place)),
        gap,
        argument: of_settings.map(str::to_owned).or(of_names),
    }
}

/// A text that is refused.
pub(crate) fn unread(py: Python<'_>, error: &ReadError) -> PyErr {
    raised(py, &SimulationError::from(error.clone()), Class::Scene)
}

/// Does something whose panic is an error too.
pub(crate) fn guarded<R>(py: Python<'_>, work: impl FnOnce() -> PyResult<R>) -> PyResult<R> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
        Err(internal(py, &text.unwrap_or_default()))
    })
}

/// A panic, which is a fault of this package.
pub(crate) fn internal(py: Python<'_>, message: &str) -> PyErr {
    let fields = Fields {
        code: "internal".to_owned(),
        message: format!("a fault of the package: {message}"),
        hint: "please report it with the scene and the call".to_owned(),
        ..Fields::default()
    };
    exception(py, Class::Base, &fields)
}
