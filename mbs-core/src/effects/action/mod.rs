//! Actions: the common form of all effects. An action consists of a law and the places of the bodies on which it acts.
//!
//! A scene has many kinds of effect, but models, outputs and other formulations know only the few kinds of [`Action`]. An effect
//! that is switched off gives no action. An effect whose Cargo feature is off is an error.

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

/// Place on a body, in the reference configuration [m].
pub type Attachment<T> = (BodyId, [T; 3]);

/// Action of one effect, or of a part of one.
#[derive(Debug, Clone, PartialEq)]
pub enum Action<T> {
    /// Law along the line between two places.
    Length {
        /// Places at both ends of the line.
        ends: [Attachment<T>; 2],
        /// Law of the tension along the line.
        law: Law<T>,
    },
    /// Law of the distance of two places along a direction: a slide. The direction is a unit vector that is fixed in the first
    /// body.
    Along {
        /// Places whose distance is measured. The direction is fixed in the body of the first place.
        ends: [Attachment<T>; 2],
        /// Unit vector of the direction, in the reference configuration.
        direction: [T; 3],
        /// Offset that is subtracted from the distance [m].
        offset: T,
        /// Joint and number of the coordinate that the distance is, if the joint has other coordinates too; else `None`.
        of: Option<(usize, usize)>,
        /// Law of the distance along the direction.
        law: Law<T>,
    },
    /// Law of the rotation of a joint about an axis.
    Angle {
        /// Index of the joint.
        joint: usize,
        /// Number of the rotation among the joint's coordinates.
        number: usize,
        /// Law of the rotation about the axis.
        law: Law<T>,
    },
    /// Law of a sum of joint coordinates and lengths, each relative to the reference configuration.
    Sum {
        /// Terms of the sum whose factor is not zero.
        terms: Vec<TermInput<T>>,
        /// Law of the sum.
        law: Law<T>,
    },
    /// Law of the planar angle of the second body relative to the first, with full turns.
    Turn {
        /// Bodies of the angle: the second rotates relative to the first.
        bodies: [BodyId; 2],
        /// Law of the angle between the bodies.
        law: Law<T>,
    },
    /// Law of one component of the rotation vector of the second body relative to the first, in space and below a full turn. The
    /// component is along a global axis of the reference configuration that is fixed in the first body. An effect has three such
    /// actions in sequence, or none.
    Rotation {
        /// Bodies of the rotation vector: the second rotates relative to the first.
        bodies: [BodyId; 2],
        /// Number of the component, from 0.
        number: u32,
        /// Law of this component of the rotation vector.
        law: Law<T>,
    },
    /// Force of constant value and direction, which has a potential.
    Constant {
        /// Index of the body, and the place on it where the force acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Force on the body [N].
        force: [T; 3],
    },
    /// Force whose value follows a signal.
    Force {
        /// Index of the body, and the place on it where the force acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Number of the signal that gives the force.
        course: u32,
        /// True if the force rotates with the body.
        turns: bool,
    },
    /// Torque on a body that follows a signal, in global axes. In the plane the first component of the signal is used.
    Torque {
        /// Index of the body that the torque acts on.
        body: usize,
        /// Number of the signal that gives the torque.
        course: u32,
    },
    /// Law that acts on one body.
    BodyLoad {
        /// Index of the body, and the place on it where the law acts, reference configuration [m].
        at: (usize, [T; 3]),
        /// Direction of the law, a unit vector fixed in the body.
        axis: [T; 3],
        /// Law that acts on the body.
        law: BodyLaw<T>,
    },
}

/// Actions of a scene, with the signals and tables that they refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Actions<T> {
    /// Actions, each with the index of its effect. An effect may have several actions in sequence.
    pub list: Vec<(usize, Action<T>)>,
    /// Prescribed functions of time, which include those of the guides.
    pub prescribed: Prescribed<T>,
    /// Tables to which the laws refer.
    pub tables: Tables<T>,
}
