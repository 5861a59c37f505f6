//! Errors of a tree, with the names of joints and bodies.

use crate::erased::Error;
use crate::erased::error::UnknownName;
use crate::names::Names;
use crate::stop::StopError;
use mbs_core::model::Owner;
use std::fmt;

/// Reason why a tree cannot be built, or cannot compute a quantity.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TreeError {
    /// Kind of the error.
    pub kind: TreeErrorKind,
    joint: Option<String>,
    body: Option<String>,
}

/// Kinds of errors of a tree.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum TreeErrorKind {
    /// The mechanism has no model in relative coordinates.
    NoTree(StopError),
    /// The mass matrix is singular, because a joint moves no inertia.
    NoInertia(StopError),
    /// The efforts determine no accelerations, for example at a singular position.
    NoAccelerations(StopError),
    /// No small motion from the current position closes the loops.
    OpenLoops(StopError),
    /// The named quantity exists only for open trees. The joint of the error closes a loop or belongs to a coupling of joints.
    Loops(&'static str),
    /// The joints cannot move the frame in some direction, so its operational-space inertia is infinite in this direction.
    Held,
    /// The given name is neither that of a frame nor that of a body.
    UnknownFrame(UnknownName),
    /// The joint closes a loop. Its equations are rows of the loop Jacobian, so it has no coordinates.
    Cut,
    /// The motion of the joint is prescribed by its guide, so it has no coordinates.
    Guided,
    /// The joint has no body to carry, because it is free between two moving bodies, or connects a body with itself.
    Idle,
    /// Wrong number of values: name of the argument, expected number, given number.
    Length(&'static str, usize, usize),
    /// A value that is infinite or not a number: name of the argument, index of the value.
    NotFinite(&'static str, usize),
    /// The given matrix is not a rotation matrix.
    NotOrthogonal,
    /// The four values of q from this index on are all zero, so they are no quaternion.
    NoRotation(usize),
}

impl TreeError {
    /// Makes a tree error from an error of the model. The tree error names the joint or body that the error of the model concerns.
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

    /// Code, hint and message of the error.
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

    /// Code, hint and message of an error in the arguments: a joint without coordinates, or invalid values.
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
