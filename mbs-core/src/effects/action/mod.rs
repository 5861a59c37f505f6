//! Actions that effects are made into, once for all models: what acts, between which places of which bodies, by which law.
//!
//! A scene has many kinds of effect; models, outputs and other formulations know only the few kinds of [`Action`]. Effects that
//! are switched off are not among them, and effects whose Cargo feature is off are an error.

mod compile;
mod road;
mod tables;

pub(crate) use compile::{Compiler, direction_of, part};
pub use road::track_heights;
pub use tables::Tables;

use crate::effects::{BodyLaw, Law};
use crate::inputs::Prescribed;
use crate::measure::TermInput;
use crate::scene::BodyId;
use alloc::vec::Vec;

/// A place on a body, reference configuration [m].
pub type Attachment<T> = (BodyId, [T; 3]);

/// Action of one effect, or of a part of one.
#[derive(Debug, Clone, PartialEq)]
pub enum Action<T> {
    /// A law along the line of two places.
    Length {
        /// Places at both ends of the line.
        ends: [Attachment<T>; 2],
        /// Law of the tension along the line.
        law: Law<T>,
    },
    /// A law of the distance of two places along a direction fixed in the first body (a unit vector): a slide.
    Along {
        /// Places whose distance counts, the first in the body that has the direction.
        ends: [Attachment<T>; 2],
        /// The direction, reference configuration.
        direction: [T; 3],
        /// Offset that the distance is counted from [m].
        offset: T,
        /// Joint and number of the coordinate that it is, where the joint has others too.
        of: Option<(usize, usize)>,
        /// Law of the distance along the direction.
        law: Law<T>,
    },
    /// A law of a turn of a joint about an axis.
    Angle {
        /// Index of the joint.
        joint: usize,
        /// The number of the turn among the joint's coordinates.
        number: usize,
        /// Law of the turn about the axis.
        law: Law<T>,
    },
    /// A law of a sum of joint coordinates and lengths, each counted from the reference configuration.
    Sum {
        /// Terms of the sum whose factor is not zero.
        terms: Vec<TermInput<T>>,
        /// Law of the sum.
        law: Law<T>,
    },
    /// A law of the angle of the second body against the first in the plane, over any number of turns.
    Turn {
        /// Bodies of the angle: the second turns against the first.
        bodies: [BodyId; 2],
        /// Law of the angle between the bodies.
        law: Law<T>,
    },
    /// A law of a component of the rotation vector of the second body against the first in space, below a whole turn. It is along a
    /// global axis of the reference configuration, fixed in the first body. An effect has three of them, one after the other, or none.
    Rotation {
        /// Bodies of the rotation vector: the second turns against the first.
        bodies: [BodyId; 2],
        /// The component, from 0.
        number: u32,
        /// Law of this component of the rotation vector.
        law: Law<T>,
    },
    /// A force that keeps its value and its direction: it has a potential.
    Constant {
        /// Index of the body, and the place on it where the force acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Force on the body [N].
        force: [T; 3],
    },
    /// A force that follows a course.
    Force {
        /// Index of the body, and the place on it where the force acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Number of the course.
        course: u32,
        /// Does it turn with the body?
        turns: bool,
    },
    /// A torque on a body that follows a course: global axes; in the plane the first component.
    Torque {
        /// Index of the body that the torque acts on.
        body: usize,
        /// Number of the course.
        course: u32,
    },
    /// A law on one body.
    BodyLoad {
        /// Index of the body, and the place on it where the law acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Direction of the law, a unit vector fixed in the body.
        axis: [T; 3],
        /// Law that acts on the body.
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
