//! Bodies, joints, initial conditions and guides.

use crate::joint::{Dimension, JointKind};
use crate::scene::{BodyId, JointId, NamedSignal, Road, SignalId, TableEnds};
use alloc::string::String;
use alloc::vec::Vec;

/// Configuration that a run starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// The reference configuration with the initial conditions.
    #[default]
    Initial,
    /// The static equilibrium downhill, a stable one, with the velocities of the initial conditions.
    Equilibrium,
    /// The static equilibrium nearby, stable or not, with the same velocities.
    EquilibriumNear,
}

/// A rigid body, or a point with mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Body<T> {
    /// Unique name of the body.
    pub name: String,
    /// Mass of the body [kg]; zero is allowed where the others determine the motion.
    pub mass: T,
    /// Centre of mass in the reference configuration [m].
    pub center: [T; 3],
    /// Inertia about the centre of mass.
    pub inertia: Inertia<T>,
    /// Factor of gravity on the body: zero for none. `None`: one.
    pub gravity_scale: Option<T>,
}

/// Inertia about the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia<T> {
    /// Uniform slender rod between two points: centre (the middle) and inertia follow from mass and length.
    Rod {
        /// One end of the rod [m].
        from: [T; 3],
        /// The other end [m].
        to: [T; 3],
    },
    /// Moment of inertia of a planar body about z [kg m^2].
    Planar(T),
    /// Inertia of a spatial body: [Ixx, Iyy, Izz, Ixy, Iyz, Izx] in global axes, products as in the matrix [kg m^2].
    Spatial([T; 6]),
    /// A point mass at the centre: it has no orientation.
    Point,
}

impl<T> Body<T> {
    /// Is it a point mass?
    #[must_use]
    pub const fn is_point(&self) -> bool {
        matches!(self.inertia, Inertia::Point)
    }
}

/// A joint between two bodies. Positive motion: second body relative to the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint<T> {
    /// Unique name of the joint.
    pub name: String,
    /// Kind of the joint.
    pub kind: JointKind,
    /// First and second body.
    pub bodies: [BodyId; 2],
    /// Place [m], one per body: equal for all kinds but links.
    pub points: [[T; 3]; 2],
    /// Axes, any length, that the kind's [freedoms](crate::scene::Freedom) name: a universal joint's first is fixed in the first
    /// body, its second in the second. A planar joint has its normal, then its first translation; a link has `axes[0]` when it
    /// is hinged. Unused ones are `None`. A planar revolute has none (its axis is +z).
    pub axes: [Option<[T; 3]>; 2],
    /// Limits that the coordinate, its rate and its effort are meant to keep to.
    pub limits: JointLimits<T>,
}

impl<T> Joint<T> {
    /// The only body that is also one of another joint's; `None`: they share none, or both.
    #[must_use]
    pub fn shared_body(&self, other: &Self) -> Option<BodyId> {
        let shares = |body: &&BodyId| other.bodies.contains(body);
        match [self.bodies.iter().find(shares), self.bodies.iter().rfind(shares)] {
            [Some(one), Some(same)] if one == same => Some(*one),
            _ => None,
        }
    }
}

/// Limits that the only coordinate of a joint, its rate and its effort are meant to keep to: data, without effect on the motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointLimits<T> {
    /// Lower and upper end of the coordinate, from the reference configuration [rad or m].
    pub range: Option<[T; 2]>,
    /// Largest force or moment along the coordinate [N m or N].
    pub effort: Option<T>,
    /// Largest rate, in both senses [rad/s or m/s].
    pub velocity: Option<T>,
}

impl<T> JointLimits<T> {
    /// No limit at all.
    pub const NONE: Self = Self { range: None, effort: None, velocity: None };

    /// The first key of scene files that is given; `None`: there is no limit at all.
    #[must_use]
    pub const fn first_key(&self) -> Option<&'static str> {
        match self {
            Self { range: Some(_), .. } => Some("range"),
            Self { effort: Some(_), .. } => Some("effort_limit"),
            Self { velocity: Some(_), .. } => Some("velocity_limit"),
            _ => None,
        }
    }
}

impl<T> Default for JointLimits<T> {
    fn default() -> Self {
        Self::NONE
    }
}

/// One `[[initial]]` entry: what is written holds exactly at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialCondition<T> {
    /// Target of the condition, with its values.
    pub target: InitialTarget<T>,
}

/// The target of an initial condition, with its values.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialTarget<T> {
    /// Joint coordinates and rates, in the order of the joint's numbers [rad, m, rad/s, m/s].
    Joint {
        /// Joint whose numbers are given.
        joint: JointId,
        /// Coordinates from the reference configuration.
        value: Option<Vec<T>>,
        /// Rates of the coordinates; for a spherical joint the relative angular velocity in global axes.
        rate: Option<Vec<T>>,
    },
    /// Velocity of a material point and/or angular velocity of a body.
    Body {
        /// Body whose velocities are given.
        body: BodyId,
        /// Material point (reference configuration) and its velocity [m, m/s].
        velocity: Option<([T; 3], [T; 3])>,
        /// Angular velocity in global axes [rad/s]; planar scenes use the third component.
        angular_velocity: Option<[T; 3]>,
    },
}

/// Kinematic guidance: a joint coordinate follows a law of time, counted from the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide<T> {
    /// Joint that is guided. Of one with several coordinates all are guided, by guides that stand one after another.
    pub joint: JointId,
    /// Number of the coordinate, in the order of the joint's coordinates; the rotation vector of a ball has three.
    pub number: usize,
    /// Law of time that the coordinate follows.
    pub law: Motion<T>,
}

/// A twice differentiable function of time.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion<T> {
    /// Cubic spline through (time, value); the end values are held outside.
    Table {
        /// The rows [s, rad or m].
        rows: Vec<[T; 2]>,
        /// Condition at both ends of the table.
        ends: TableEnds,
    },
    /// Through (time, value), between the values of the neighbouring rows; the end values are held outside.
    Monotone {
        /// The rows [s, rad or m].
        rows: Vec<[T; 2]>,
        /// Condition at both ends of the table.
        ends: TableEnds,
    },
    /// amplitude * sin(2 pi frequency t + phase)   [rad or m, Hz, rad].
    Sine {
        /// Amplitude [rad or m].
        amplitude: T,
        /// Frequency of the sine [Hz].
        frequency: T,
        /// Phase at time zero [rad].
        phase: T,
    },
    /// Value, rate and acceleration, held until they are set again between steps; these at the start.
    Input([T; 3]),
    /// rate * t   [rad/s or m/s].
    Ramp {
        /// Rate [rad/s or m/s].
        rate: T,
    },
    /// A signal of the scene, which is [smooth](crate::scene::Smoothness).
    Signal(SignalId),
}

/// Surroundings of an effect: the parts of its scene that it may refer to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings<'a, T> {
    pub(crate) dimension: Dimension,
    pub(crate) bodies: &'a [Body<T>],
    pub(crate) joints: &'a [Joint<T>],
    pub(crate) road: &'a Road<T>,
    pub(crate) signals: &'a [NamedSignal<T>],
}
