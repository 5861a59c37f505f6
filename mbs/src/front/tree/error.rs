//! What a tree refuses, with names.

use crate::names::Names;
use crate::stop::StopError;
use std::fmt;

/// Why there is no tree, or why it does not answer.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum TreeError {
    /// The mechanism has no model in relative coordinates.
    NoTree {
        /// Why.
        reason: StopError,
        /// The joint that it is about.
        joint: Option<String>,
        /// The body that it is about.
        body: Option<String>,
    },
    /// No accelerations follow from the efforts.
    NoAccelerations {
        /// Why.
        reason: StopError,
        /// The joint that it is about.
        joint: Option<String>,
    },
    /// The joint closes a loop: its equations are rows of the loops, it has no coordinates.
    Cut {
        /// Its name.
        joint: String,
    },
    /// The joint follows its guide: it has no coordinates.
    Guided {
        /// Its name.
        joint: String,
    },
    /// The joint neither holds nor carries anything: it is free between two moving bodies, or within one body.
    NoCoordinates {
        /// Its name.
        joint: String,
    },
    /// Too many numbers, or too few.
    Length {
        /// `"q"`, `"v"`, `"effort"`, `"accelerations"` or `"motions"`.
        what: &'static str,
        /// What the tree has.
        expected: usize,
        /// What was given.
        found: usize,
    },
    /// A number is infinite or none.
    NotFinite {
        /// As above.
        what: &'static str,
        /// Its place.
        index: usize,
    },
    /// Four numbers that are all zero are no quaternion.
    NoRotation {
        /// Place of the first one in q.
        first: usize,
    },
}

impl TreeError {
    pub(super) fn no_tree(reason: StopError, names: &Names) -> Self {
        let (joint, body) = reason.owner().map_or((None, None), |owner| names.of(owner));
        Self::NoTree { reason, joint, body }
    }

    pub(super) fn no_accelerations(reason: StopError, names: &Names) -> Self {
        let joint = reason.owner().and_then(|owner| names.of(owner).0);
        Self::NoAccelerations { reason, joint }
    }

    /// A short fixed word for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::NoTree { .. } => "no-tree",
            Self::NoAccelerations { .. } => "no-accelerations",
            Self::Cut { .. } => "cut-joint",
            Self::Guided { .. } => "guided-joint",
            Self::NoCoordinates { .. } => "no-coordinates",
            Self::Length { .. } => "wrong-length",
            Self::NotFinite { .. } => "not-finite",
            Self::NoRotation { .. } => "no-rotation",
        }
    }

    /// The name of the joint that it is about.
    #[must_use]
    pub fn joint(&self) -> Option<&str> {
        match self {
            Self::NoTree { joint, .. } | Self::NoAccelerations { joint, .. } => joint.as_deref(),
            Self::Cut { joint } | Self::Guided { joint } | Self::NoCoordinates { joint } => {
                Some(joint)
            }
            Self::Length { .. } | Self::NotFinite { .. } | Self::NoRotation { .. } => None,
        }
    }

    /// The name of the body that it is about.
    #[must_use]
    pub fn body(&self) -> Option<&str> {
        if let Self::NoTree { body, .. } = self { body.as_deref() } else { None }
    }

    /// What to do.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::NoTree { reason, .. } => reason.hint(),
            Self::NoAccelerations { .. } => {
                "leave this position, in which the loops are singular; check that q and v close the loops: `follow` a simulation there"
            }
            Self::Cut { .. } => "use `loop_jacobian`, or coordinates of another joint of the loop",
            Self::Guided { .. } => "use its guide, or leave the guide out",
            Self::NoCoordinates { .. } => "use the joints that hold its bodies",
            Self::Length { .. } => {
                "make it as long as `coordinates` for q, as `velocities` for all others"
            }
            Self::NotFinite { .. } => "give finite numbers",
            Self::NoRotation { .. } => {
                "give a quaternion (w, x, y, z); no rotation is (1, 0, 0, 0)"
            }
        }
    }
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTree { reason, joint, body } => {
                if let Some(name) = joint.as_ref().or(body.as_ref()) {
                    write!(f, "`{name}`: ")?;
                }
                write!(f, "{reason}")
            }
            Self::NoAccelerations { reason, .. } => {
                write!(f, "no accelerations follow from the efforts: {reason}")
            }
            Self::Cut { joint } => write!(f, "`{joint}` closes a loop and has no coordinates"),
            Self::Guided { joint } => write!(f, "`{joint}` is guided and has no coordinates"),
            Self::NoCoordinates { joint } => {
                write!(f, "`{joint}` constrains nothing and has no coordinates")
            }
            Self::Length { what, expected, found } => {
                write!(f, "{what} has {found} numbers, and the tree {expected}")
            }
            Self::NotFinite { what, index } => write!(f, "{what}[{index}] is not finite"),
            Self::NoRotation { first } => {
                write!(f, "q[{first}] and the three numbers behind it are no quaternion")
            }
        }
    }
}

impl std::error::Error for TreeError {}
