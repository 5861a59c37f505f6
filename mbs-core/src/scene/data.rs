//! Bodies, joints, initial conditions and guides.

use crate::joint::{Dimension, JointKind};
use crate::scene::{BodyId, JointId, NamedSignal, Road, SignalId, TableEnds};
use alloc::string::String;
use alloc::vec::Vec;

/// Configuration from which a run starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// The reference configuration with the initial conditions.
    #[default]
    Initial,
    /// Stable static equilibrium, found by descent of the potential, with the velocities of the initial conditions.
    Equilibrium,
    /// Static equilibrium close to the initial configuration, stable or not, with the velocities of the initial conditions.
    EquilibriumNear,
}

/// A rigid body, or a point with mass.
#[derive(Debug, Clone, PartialEq)]
pub struct Body<T> {
    /// Unique name of the body.
    pub name: String,
    /// Mass of the body [kg]. Zero is allowed if the other masses determine the motion.
    pub mass: T,
    /// Centre of mass in the reference configuration [m].
    pub center: [T; 3],
    /// Inertia about the centre of mass.
    pub inertia: Inertia<T>,
    /// Factor of gravity on the body. Zero switches gravity off; `None` means one.
    pub gravity_scale: Option<T>,
}

/// Inertia about the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia<T> {
    /// Uniform slender rod between two points. The centre (its middle) and the inertia follow from mass and length.
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
    /// True if the body is a point mass.
    #[must_use]
    pub const fn is_point(&self) -> bool {
        matches!(self.inertia, Inertia::Point)
    }
}

/// Joint between two bodies. A positive coordinate moves the second body relative to the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint<T> {
    /// Unique name of the joint.
    pub name: String,
    /// Kind of the joint.
    pub kind: JointKind,
    /// First and second body.
    pub bodies: [BodyId; 2],
    /// Place of the joint on each body [m]. The two places are equal for all kinds but links.
    pub points: [[T; 3]; 2],
    /// Axes of any length, named by the kind's [freedoms](crate::scene::Freedom); unused ones are `None`. A universal joint has its
    /// first axis fixed in the first body and its second in the second body. A planar joint has its normal, then its first
    /// translation. A link has `axes[0]` if it is hinged. A planar revolute joint has no axis, because it turns about z.
    pub axes: [Option<[T; 3]>; 2],
    /// Intended limits of the coordinate, its rate and its effort.
    pub limits: JointLimits<T>,
}

impl<T> Joint<T> {
    /// Body that belongs to both joints. `None` if the joints have no body in common, or two.
    #[must_use]
    pub fn shared_body(&self, other: &Self) -> Option<BodyId> {
        let shares = |body: &&BodyId| other.bodies.contains(body);
        match [self.bodies.iter().find(shares), self.bodies.iter().rfind(shares)] {
            [Some(one), Some(same)] if one == same => Some(*one),
            _ => None,
        }
    }
}

/// Intended limits of a joint's only coordinate, its rate and its effort. They are data without effect on the motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointLimits<T> {
    /// Lower and upper end of the coordinate, relative to the reference configuration [rad or m].
    pub range: Option<[T; 2]>,
    /// Largest force or moment along the coordinate [N m or N].
    pub effort: Option<T>,
    /// Largest rate, in both senses [rad/s or m/s].
    pub velocity: Option<T>,
}

impl<T> JointLimits<T> {
    /// Joint limits without any limit.
    pub const NONE: Self = Self { range: None, effort: None, velocity: None };

    /// Key in scene files of the first limit that is given; `None` if there is no limit.
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

/// Initial condition from one `[[initial]]` entry, which holds exactly at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct InitialCondition<T> {
    /// Target of the condition, with its values.
    pub target: InitialTarget<T>,
}

/// Target of an initial condition, with its values.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialTarget<T> {
    /// Coordinates and rates of a joint, in the order of its coordinates [rad, m, rad/s, m/s].
    Joint {
        /// Joint whose numbers are given.
        joint: JointId,
        /// Coordinates from the reference configuration.
        value: Option<Vec<T>>,
        /// Rates of the coordinates; for a spherical joint the relative angular velocity in global axes.
        rate: Option<Vec<T>>,
    },
    /// Velocity of a material point of a body, its angular velocity, or both.
    Body {
        /// Body whose velocities are given.
        body: BodyId,
        /// Material point (reference configuration) and its velocity [m, m/s].
        velocity: Option<([T; 3], [T; 3])>,
        /// Angular velocity in global axes [rad/s]; planar scenes use the third component.
        angular_velocity: Option<[T; 3]>,
    },
}

/// Guide: a joint coordinate follows a function of time, relative to the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide<T> {
    /// Joint that is guided. All coordinates of a joint must be guided, by guides that follow each other.
    pub joint: JointId,
    /// Number of the coordinate, in the order of the joint's coordinates. The rotation vector of a ball joint has three.
    pub number: usize,
    /// Function of time that the coordinate follows.
    pub law: Motion<T>,
}

/// Twice differentiable function of time.
#[derive(Debug, Clone, PartialEq)]
pub enum Motion<T> {
    /// Cubic spline through rows (time, value). Before the first and after the last row the end value is held.
    Table {
        /// The rows [s, rad or m].
        rows: Vec<[T; 2]>,
        /// Condition at both ends of the table.
        ends: TableEnds,
    },
    /// Monotone table of rows (time, value), which stays between neighbouring values. Outside the rows the end value is held.
    Monotone {
        /// The rows [s, rad or m].
        rows: Vec<[T; 2]>,
        /// Condition at both ends of the table.
        ends: TableEnds,
    },
    /// Sine wave: amplitude * sin(2 pi frequency t + phase)   [rad or m, Hz, rad].
    Sine {
        /// Amplitude [rad or m].
        amplitude: T,
        /// Frequency of the sine [Hz].
        frequency: T,
        /// Phase at time zero [rad].
        phase: T,
    },
    /// Input: value, rate and acceleration, held until they are set between steps. These are the values at the start.
    Input([T; 3]),
    /// Ramp: rate * t   [rad/s or m/s].
    Ramp {
        /// Rate [rad/s or m/s].
        rate: T,
    },
    /// Signal of the scene, which must be [smooth](crate::scene::Smoothness).
    Signal(SignalId),
}

/// Surroundings of an effect: the parts of a scene that the effect may refer to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings<'a, T> {
    pub(crate) dimension: Dimension,
    pub(crate) bodies: &'a [Body<T>],
    pub(crate) joints: &'a [Joint<T>],
    pub(crate) road: &'a Road<T>,
    pub(crate) signals: &'a [NamedSignal<T>],
}
