//! Errors of the front door: each with a code, what it is about by name, and what to do.

use core::fmt::{self, Display, Formatter};
use mbs_core::scene::{Entry, Number, Scene, SceneError as Refused};
use mbs_scene::{Place, ReadError, SweepFault, WriteError, nearest_name};

/// Error of the front door: its code, time, joint, body, hint and place in the file.
pub trait Error: core::error::Error {
    /// Code of the error, a word that does not change.
    fn code(&self) -> &'static str;
    /// Time in the run [s].
    fn time(&self) -> Option<f64> {
        None
    }
    /// The joint that it is about.
    fn joint(&self) -> Option<&str> {
        None
    }
    /// The body that it is about.
    fn body(&self) -> Option<&str> {
        None
    }
    /// Hint on what to do.
    fn hint(&self) -> Option<String> {
        None
    }
    /// Line and column of the file.
    fn place(&self) -> Option<Place> {
        None
    }
}

impl Error for ReadError {
    fn code(&self) -> &'static str {
        "scene-refused"
    }
    fn hint(&self) -> Option<String> {
        Some(self.hint()).filter(|hint| !hint.is_empty())
    }
    fn place(&self) -> Option<Place> {
        Some(self.place().clone())
    }
}

impl Error for WriteError {
    fn code(&self) -> &'static str {
        "not-written"
    }
}

/// A name that no part of that kind has.
#[derive(Debug, Clone, PartialEq)]
pub struct UnknownName {
    pub word: &'static str,
    pub name: String,
    pub known: Vec<String>,
}

impl Display for UnknownName {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "there is no {} `{}`", self.word, self.name)?;
        self.hint().map_or(Ok(()), |hint| write!(f, ": {hint}"))
    }
}

impl UnknownName {
    /// Returns the kind of part that has no such name: `output`.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        self.word
    }
}

impl core::error::Error for UnknownName {}

impl Error for UnknownName {
    fn code(&self) -> &'static str {
        "unknown-name"
    }
    fn hint(&self) -> Option<String> {
        Some(nearest_name(&self.name, &self.known, "names"))
    }
}

/// A path that leads to no number, or a mechanism that has no paths.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PathError {
    /// The path leads to no number.
    Path {
        /// The path as given.
        path: String,
        /// Fault of the path.
        fault: SweepFault,
    },
    /// The number makes no scene of the mechanism.
    Refused(ReadError),
    /// The number is infinite or none.
    NotFinite {
        /// The path as given.
        path: String,
    },
    /// The mechanism has a part that is code, and so no text for paths to lead into.
    NotWritten(WriteError),
}

impl Display for PathError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Path { path, fault } => write!(f, "`{path}`: {fault}"),
            Self::NotFinite { path } => write!(f, "`{path}`: the number is infinite or none"),
            Self::Refused(error) => error.fmt(f),
            Self::NotWritten(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for PathError {}

impl Error for PathError {
    fn code(&self) -> &'static str {
        match self {
            Self::Path { .. } => "unknown-path",
            Self::NotFinite { .. } => "not-finite",
            Self::Refused(error) => error.code(),
            Self::NotWritten(error) => error.code(),
        }
    }
    fn hint(&self) -> Option<String> {
        match self {
            Self::Path { fault, .. } => Some(fault.hint()),
            Self::NotFinite { .. } => Some("give a finite number".to_owned()),
            Self::Refused(error) => Error::hint(error),
            Self::NotWritten(error) => Error::hint(error),
        }
    }
}

/// A mechanism that is refused before a model is built: the part by its name, the key, and what is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError {
    error: Refused,
    part: String,
    place: Option<Box<Place>>,
}

impl SceneError {
    /// `columns` are the names of all outputs.
    pub fn new<'a>(
        error: Refused,
        scene: &Scene<Number>,
        mut columns: impl Iterator<Item = &'a String>,
        place: Option<Place>,
    ) -> Self {
        let name = |name: Option<&String>| name.cloned().unwrap_or_default();
        let part = match error.entry {
            Entry::Body(i) => name(scene.bodies.get(i).map(|body| &body.name)),
            Entry::Joint(i) => name(scene.joints.get(i).map(|joint| &joint.name)),
            Entry::Signal(i) => name(scene.signals.get(i).map(|signal| &signal.name)),
            Entry::Frame(i) => name(scene.frames.get(i).map(|frame| &frame.name)),
            Entry::Shape(i) => name(scene.shapes.get(i).map(|shape| &shape.name)),
            Entry::Effect(i) => name(scene.effects.get(i).map(|effect| &effect.name)),
            Entry::Output(i) => name(columns.nth(i)),
            _ => String::new(),
        };
        Self { error, part, place: place.map(Box::new) }
    }

    /// The entry, its key and the fault with its numbers.
    #[must_use]
    pub fn error(&self) -> &Refused {
        &self.error
    }
}

impl Display for SceneError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Refused { entry, field, fault } = &self.error;
        if self.part.is_empty() {
            return write!(f, "`{field}` of {entry} {fault:#}");
        }
        write!(f, "`{field}` of {entry}, `{}`, {fault:#}", self.part)
    }
}

impl core::error::Error for SceneError {}

impl Error for SceneError {
    fn code(&self) -> &'static str {
        "scene-refused"
    }
    fn joint(&self) -> Option<&str> {
        matches!(self.error.entry, Entry::Joint(_)).then_some(&*self.part)
    }
    fn body(&self) -> Option<&str> {
        matches!(self.error.entry, Entry::Body(_)).then_some(&*self.part)
    }
    fn hint(&self) -> Option<String> {
        Some(self.error.fault.advice().to_owned())
    }
    fn place(&self) -> Option<Place> {
        self.place.as_deref().cloned()
    }
}
