//! Errors of a tree, with names.

use crate::erased::Error;
use crate::erased::error::UnknownName;
use crate::names::Names;
use crate::stop::StopError;
use mbs_core::model::Owner;
use std::fmt;

/// Reason why there is no tree, or why it does not answer.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TreeError {
    /// Fault of the tree, or of what it was asked.
    pub kind: TreeErrorKind,
    joint: Option<String>,
    body: Option<String>,
}

/// Faults of a tree, or of what it was asked.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum TreeErrorKind {
    /// The mechanism has no model in relative coordinates.
    NoTree(StopError),
    /// No accelerations follow from any efforts: a joint meets no inertia.
    NoInertia(StopError),
    /// No accelerations follow from the efforts.
    NoAccelerations(StopError),
    /// From the position no small motion closes the loops.
    OpenLoops(StopError),
    /// The question is for open trees alone, but the joint closes a loop, or it is a coupling that ties joints.
    Loops(&'static str),
    /// No forces move the frame in some direction: it has no inertia there, because the joints do not move it so.
    Held,
    /// No frame has this name, and no body.
    UnknownFrame(UnknownName),
    /// The joint closes a loop: its equations are rows of the loop Jacobian.
    Cut,
    /// The joint follows its guide.
    Guided,
    /// The joint carries nothing: it is free between two moving bodies, or within one body.
    Idle,
    /// Too many numbers, or too few: what they are, how many the tree has, how many were given.
    Length(&'static str, usize, usize),
    /// An infinite number or none: what it is, and its place.
    NotFinite(&'static str, usize),
    /// The rows that are given are not those of a rotation.
    NotOrthogonal,
    /// Four zeros from this place of q are no quaternion.
    NoRotation(usize),
}

impl TreeError {
    /// Makes an error about the joint or body that an error of the model names.
    pub fn of_model(
        kind: fn(StopError) -> TreeErrorKind,
        (reason, names): (StopError, &Names),
    ) -> Self {
        let owner = reason.owner();
        Self::of_owner(kind(reason), (owner, names))
    }

    pub fn of_owner(kind: TreeErrorKind, (owner, names): (Option<Owner>, &Names)) -> Self {
        let (joint, body) = owner.map_or((None, None), |owner| names.of(owner));
        Self { kind, joint, body }
    }

    pub fn of_joint(kind: TreeErrorKind, joint: &str) -> Self {
        Self { kind, joint: Some(joint.to_owned()), body: None }
    }

    /// Code, hint and message.
    fn words(&self) -> (&'static str, &'static str, String) {
        use TreeErrorKind as Kind;
        match &self.kind {
            Kind::NoTree(reason) => ("no-tree", reason.hint(), reason.to_string()),
            Kind::NoInertia(reason) => (
                "no-inertia",
                "give the body mass and inertia; places, Jacobians, inverse kinematics and the efforts of given accelerations need none",
                format!("no accelerations follow from forces: {reason}"),
            ),
            Kind::NoAccelerations(reason) => (
                "no-accelerations",
                "leave this position, in which loops are singular; check that q and v close them, as those of a simulation do",
                format!("no accelerations follow from the efforts: {reason}"),
            ),
            Kind::OpenLoops(reason) => (
                "open-loops",
                "begin from a position in which the loops are closed, such as that of a simulation",
                format!("the loops cannot be closed from this position: {reason}"),
            ),
            Kind::Loops(what) => (
                "closed-loops",
                "take differences of the accelerations, or leave out what ties joints to each other",
                format!("{what} are of open trees, and this closes a loop or ties joints"),
            ),
            Kind::Held => (
                "held-frame",
                "ask for `frame_mobility`, its inverse, which every position has",
                "the joints do not move the frame in every direction: it has no inertia there"
                    .into(),
            ),
            Kind::UnknownFrame(error) => {
                (error.code(), "", format!("there is no frame `{}`", error.name))
            }
            Kind::Cut
            | Kind::Guided
            | Kind::Idle
            | Kind::Length(..)
            | Kind::NotFinite(..)
            | Kind::NotOrthogonal
            | Kind::NoRotation(_) => self.words_of_arguments(),
        }
    }

    /// Code, hint and message of a fault in what was given: a joint without coordinates, or numbers.
    fn words_of_arguments(&self) -> (&'static str, &'static str, String) {
        use TreeErrorKind as Kind;
        let no_coordinates = |whose| format!("a joint that {whose} has no coordinates");
        match &self.kind {
            Kind::Guided => (
                "guided-joint",
                "use its guide, or leave the guide out",
                no_coordinates("is guided"),
            ),
            Kind::Cut => {
                let hint = "use `loop_jacobian`, or coordinates of another joint of the loop";
                ("cut-joint", hint, no_coordinates("closes a loop"))
            }
            Kind::Length(what, expected, found) => {
                let hint = match *what {
                    "motions" => "follow a simulation of the mechanism that the tree is of",
                    _ => "make q as long as `coordinates`, all others as `velocities`",
                };
                let message = format!("{what} has {found} numbers, and the tree {expected}");
                ("wrong-length", hint, message)
            }
            Kind::NotFinite(what, place) => {
                ("not-finite", "give finite numbers", format!("{what}[{place}] is not finite"))
            }
            Kind::NotOrthogonal => (
                "no-rotation",
                "give unit vectors at right angles, right-handed; no rotation is 1 0 0, 0 1 0, 0 0 1",
                "the rows of the target are not those of a rotation".into(),
            ),
            Kind::NoRotation(place) => {
                let message =
                    format!("q[{place}] and the three numbers behind it are no quaternion");
                ("no-rotation", "give (w, x, y, z); no rotation is (1, 0, 0, 0)", message)
            }
            _ => {
                let hint = "use the joints that hold its bodies";
                ("no-coordinates", hint, no_coordinates("carries nothing"))
            }
        }
    }
}

impl From<UnknownName> for TreeError {
    fn from(error: UnknownName) -> Self {
        TreeErrorKind::UnknownFrame(error).into()
    }
}

impl From<TreeErrorKind> for TreeError {
    fn from(kind: TreeErrorKind) -> Self {
        Self { kind, joint: None, body: None }
    }
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, _, message) = self.words();
        match self.joint().or(self.body()) {
            Some(name) => write!(f, "`{name}`: {message}"),
            None => write!(f, "{message}"),
        }
    }
}

impl std::error::Error for TreeError {}

impl Error for TreeError {
    fn code(&self) -> &'static str {
        self.words().0
    }
    fn joint(&self) -> Option<&str> {
        self.joint.as_deref()
    }
    fn body(&self) -> Option<&str> {
        self.body.as_deref()
    }
    fn hint(&self) -> Option<String> {
        match &self.kind {
            TreeErrorKind::UnknownFrame(error) => error.hint(),
            _ => Some(self.words().1.to_owned()),
        }
    }
}
