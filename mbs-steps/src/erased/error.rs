//! Errors of the public API: each has a code, the names of the parts concerned, and a hint.

use core::fmt::{self, Display, Formatter};
use mbs_core::scene::{Entry, Number, Scene, SceneError as Refused};
use mbs_scene::{Place, ReadError, SweepFault, WriteError, nearest_name};

/// Error of the public API: its code, time, joint, body, hint and place in the file.
pub trait Error: core::error::Error {
    /// Code of the error: a constant word for programs, which is part of the contract (docs/CONTRACT.md).
    fn code(&self) -> &'static str;
    /// Time in the run [s].
    fn time(&self) -> Option<f64> {
        None
    }
    /// Name of the joint that the error concerns.
    fn joint(&self) -> Option<&str> {
        None
    }
    /// Name of the body that the error concerns.
    fn body(&self) -> Option<&str> {
        None
    }
    /// Hint for the user: what to do about the error.
    fn hint(&self) -> Option<String> {
        None
    }
    /// Line and column of the error in the file.
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

/// Error for a name that no part of the given kind has.
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
    /// Returns the kind of the unknown part, such as `output`.
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

/// Error of a path that should lead to a number of a mechanism, or of a mechanism that has no paths.
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
    /// The scene is not valid with the new number.
    Refused(ReadError),
    /// The number is infinite or not a number.
    NotFinite {
        /// The path as given.
        path: String,
    },
    /// The mechanism has a user-defined part, so it cannot be written as text and has no paths.
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

/// Error of a scene that is found before a model is built: the name of the part, the key, and the message.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneError {
    error: Refused,
    part: String,
    place: Option<Box<Place>>,
}

impl SceneError {
    /// Creates the error; `columns` are the names of all outputs.
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

    /// Returns the entry, its key, and the fault with its values.
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
