//! Opt-in effects, as data.

use crate::scene::BodyRef;
use alloc::string::String;
use alloc::vec::Vec;

/// An opt-in effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect<T> {
    /// Unique name among the effects (given, or `effect-N`).
    pub name: String,
    /// Switched off when false: then nothing of it is built.
    pub enabled: bool,
    /// What it does.
    pub kind: EffectKind<T>,
}

/// A constant, or a table over time (linear between the points, the end values held outside).
#[derive(Debug, Clone, PartialEq)]
pub enum Course<T> {
    /// The same at all times; planar torques and joint torques use the first component only.
    Constant([T; 3]),
    /// Rows of (time, value).
    Table(Vec<(T, [T; 3])>),
}

/// Axes in which a force is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisFrame {
    /// Fixed directions.
    Global,
    /// Turning with the body (global axes of the reference configuration at the start).
    Body,
}

/// The kinds of effect.
#[derive(Debug, Clone, PartialEq)]
pub enum EffectKind<T> {
    /// tension = stiffness (length - free_length) + damping d(length)/dt between two body points.
    SpringDamper {
        /// First and second body.
        bodies: [BodyRef; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// Stiffness [N/m].
        stiffness: T,
        /// Damping [N s/m].
        damping: T,
        /// Length without tension [m].
        free_length: T,
    },
    /// torque on the second body = -(stiffness (angle - free_value) + damping rate) about a revolute joint's axis.
    TorsionSpring {
        /// Index of the joint.
        joint: usize,
        /// Stiffness [N m/rad].
        stiffness: T,
        /// Damping [N m s/rad].
        damping: T,
        /// Angle without torque [rad].
        free_value: T,
    },
    /// A force at a point of a body.
    Force {
        /// Index of the body.
        body: usize,
        /// Point of application, reference configuration [m].
        at: [T; 3],
        /// Force [N].
        course: Course<T>,
        /// Axes of the force.
        frame: AxisFrame,
    },
    /// A torque on a body, from the ground: planar counter-clockwise in the first component, spatial a vector in global axes [N m].
    BodyTorque {
        /// Index of the body.
        body: usize,
        /// Torque [N m].
        course: Course<T>,
    },
    /// A torque of the first body on the second about the joint's axis (first component) [N m].
    JointTorque {
        /// Index of the joint.
        joint: usize,
        /// Torque [N m].
        course: Course<T>,
    },
}
