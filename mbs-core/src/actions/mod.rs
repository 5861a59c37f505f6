//! Effects written as laws, once for all models: what acts, between which places of which bodies, by which law.
//!
//! A scene has many kinds of effect; models, outputs and other formulations know only the few kinds of [`Action`]. Effects that
//! are switched off are not among them, and effects whose Cargo feature is off are an error.

mod compile;
mod error;
mod from_scene;
mod needs;
mod road;
mod tables;

pub(crate) use compile::{Compiler, direction_of, part};
pub use error::ActionError;
pub(crate) use needs::{Need, needs};
pub use road::track_heights;
pub use tables::Tables;

use crate::inputs::Prescribed;
use crate::laws::body::BodyLaw;
use crate::laws::scalar::Law;
use crate::measure::TermInput;
use crate::scene::BodyId;
use alloc::vec::Vec;

/// A place on a body, reference configuration [m].
pub type Attachment<T> = (BodyId, [T; 3]);

/// What one effect, or a part of one, does.
#[derive(Debug, Clone, PartialEq)]
pub enum Action<T> {
    /// A law along the line of two places.
    Length {
        /// The places.
        ends: [Attachment<T>; 2],
        /// The law.
        law: Law<T>,
    },
    /// A law of the distance of two places along a direction fixed in the first body (a unit vector): a slide.
    Along {
        /// The places.
        ends: [Attachment<T>; 2],
        /// The direction, reference configuration.
        direction: [T; 3],
        /// What the distance is counted from [m].
        offset: T,
        /// Joint and number of the coordinate that it is, where the joint has others too.
        of: Option<(usize, usize)>,
        /// The law.
        law: Law<T>,
    },
    /// A law of a turn of a joint about an axis.
    Angle {
        /// Index of the joint.
        joint: usize,
        /// The number of the turn among the joint's coordinates.
        number: usize,
        /// The law.
        law: Law<T>,
    },
    /// A law of a sum of joint coordinates and lengths, each counted from the reference configuration.
    Sum {
        /// Its terms whose factor is not zero.
        terms: Vec<TermInput<T>>,
        /// The law.
        law: Law<T>,
    },
    /// A law of the angle of the second body against the first in the plane, over any number of turns.
    Turn {
        /// The bodies.
        bodies: [BodyId; 2],
        /// The law.
        law: Law<T>,
    },
    /// A law of a component of the rotation vector of the second body against the first in space, below a whole turn. It is along a
    /// global axis of the reference configuration, fixed in the first body. An effect has three of them, one after the other, or none.
    Rotation {
        /// The bodies.
        bodies: [BodyId; 2],
        /// The component, from 0.
        number: u32,
        /// The law.
        law: Law<T>,
    },
    /// A force that keeps its value and its direction: it has a potential.
    Constant {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// The force [N].
        force: [T; 3],
    },
    /// A force that follows a course.
    Force {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// Number of the course.
        course: u32,
        /// Does it turn with the body?
        turns: bool,
    },
    /// A torque on a body that follows a course: global axes; in the plane the first component.
    Torque {
        /// The body.
        body: usize,
        /// Number of the course.
        course: u32,
    },
    /// A law on one body.
    BodyLoad {
        /// Where it acts.
        at: (usize, [T; 3]),
        /// Its direction, a unit vector fixed in the body.
        axis: [T; 3],
        /// The law.
        law: BodyLaw<T>,
    },
}

/// The actions of a scene with everything they refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Actions<T> {
    /// Index of the effect, and the action. An effect may have several, one after the other.
    pub list: Vec<(usize, Action<T>)>,
    /// Prescribed functions of time; those of the guides stand here too.
    pub prescribed: Prescribed<T>,
    /// Tables of the laws.
    pub tables: Tables<T>,
}
