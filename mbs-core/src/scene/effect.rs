//! Opt-in effects, as data.

use crate::laws::own::{UserBodyLaw, UserScalarLaw};
use crate::scene::{BodyId, JointId};
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
pub enum Signal<T> {
    /// The same at all times; planar torques and joint torques use the first component only.
    Constant([T; 3]),
    /// Rows of (time, value).
    Table(Vec<(T, [T; 3])>),
    /// Held until it is set again between steps; this at the start.
    Input([T; 3]),
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
        bodies: [BodyId; 2],
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
        /// The joint.
        joint: JointId,
        /// Stiffness [N m/rad].
        stiffness: T,
        /// Damping [N m s/rad].
        damping: T,
        /// Angle without torque [rad].
        free_value: T,
    },
    /// A force at a point of a body.
    Force {
        /// The body.
        body: BodyId,
        /// Point of application, reference configuration [m].
        at: [T; 3],
        /// Force [N].
        course: Signal<T>,
        /// Axes of the force.
        frame: AxisFrame,
    },
    /// A torque on a body, from the ground: planar counter-clockwise in the first component, spatial a vector in global axes [N m].
    BodyTorque {
        /// The body.
        body: BodyId,
        /// Torque [N m].
        course: Signal<T>,
    },
    /// A torque of the first body on the second about the joint's axis (first component) [N m].
    JointTorque {
        /// The joint.
        joint: JointId,
        /// Torque [N m].
        course: Signal<T>,
    },
    /// A force along the line of two body points that follows a course, positive when it pushes them apart [N].
    Actuator {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// Force, first component [N].
        course: Signal<T>,
    },
    /// A piecewise polynomial between two body points: tension of the length (a spring) or of its rate (a damper).
    Polynomial {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// The length is measured along this direction, fixed in the first body, instead of between the points.
        direction: Option<[T; 3]>,
        /// Of the length's rate instead of the length.
        of_rate: bool,
        /// Pieces, in increasing order and without gaps.
        pieces: Vec<PolynomialPiece<T>>,
    },
    /// Pushes two points apart once they have come closer than their reference distance less the clearance.
    Bumper {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// Stiffness [N/m].
        stiffness: T,
        /// Damping while in contact [N s/m].
        damping: T,
        /// Approach from the reference configuration before contact [m].
        clearance: T,
    },
    /// Six springs and dampers between two bodies at a place, in body axes of the first.
    Bushing {
        /// First and second body.
        bodies: [BodyId; 2],
        /// Place, reference configuration [m].
        at: [T; 3],
        /// Stiffness along x, y, z [N/m] and about x, y, z [N m/rad]; in the plane x, y and the third rotation.
        stiffness: [T; 6],
        /// Damping, likewise.
        damping: [T; 6],
    },
    /// Elastic stops of a joint with one coordinate.
    Limit {
        /// The joint.
        joint: JointId,
        /// Coordinate below which the lower stop pushes [rad or m].
        lower: T,
        /// Coordinate above which the upper stop pushes [rad or m].
        upper: T,
        /// Stiffness [N m/rad or N/m].
        stiffness: T,
        /// Damping while in contact [N m s/rad or N s/m].
        damping: T,
    },
    /// Stribeck friction of a joint with one coordinate, regularised.
    Friction {
        /// The joint.
        joint: JointId,
        /// Friction of fast motion [N m or N].
        coulomb: T,
        /// Friction of slow motion [N m or N].
        r#static: T,
        /// Rate at which the one becomes the other [rad/s or m/s].
        stribeck: T,
        /// Viscous part [N m s/rad or N s/m].
        viscous: T,
        /// Rate below which friction falls to zero with the rate [rad/s or m/s].
        regularisation: T,
    },
    /// Drag of still air, against the velocity of a point.
    AeroDrag {
        /// The body.
        body: BodyId,
        /// Point, reference configuration [m].
        at: [T; 3],
        /// Drag coefficient times area [m^2].
        area_coefficient: T,
        /// Density of air [kg/m^3].
        density: T,
    },
    /// A force at the centre of mass along a direction of the body that holds its speed.
    SpeedHold {
        /// The body.
        body: BodyId,
        /// Direction, fixed in the body.
        direction: [T; 3],
        /// Speed to hold [m/s].
        speed: T,
        /// Force per speed [N s/m].
        gain: T,
        /// Largest force [N].
        limit: T,
    },
    /// A wheel on the scene's road.
    Tire {
        /// The body that carries the wheel.
        body: BodyId,
        /// Centre of the wheel, reference configuration [m].
        center: [T; 3],
        /// Axis of the wheel, fixed in the body, pointing to the left of the direction of travel. Planar scenes: `None`.
        axis: Option<[T; 3]>,
        /// Radius without load [m].
        radius: T,
        /// Radial stiffness [N/m].
        stiffness: T,
        /// Radial damping while in contact [N s/m].
        damping: T,
        /// Force against rolling, as a share of the normal force [-].
        rolling_resistance: T,
        /// Side force and aligning torque; `None`: only the radial force.
        side: Option<CalspanCoefficients<T>>,
    },
    /// A law of a user's own, in code only.
    Own {
        /// The law and where it acts.
        law: UserLaw<T>,
        /// Its input.
        course: Signal<T>,
    },
}

/// Where a law of a user's own acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UserLaw<T> {
    /// Along the line of two body points.
    Length {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// The law.
        law: UserScalarLaw<T>,
    },
    /// On the coordinate of a joint that has one.
    Joint {
        /// The joint.
        joint: JointId,
        /// The law.
        law: UserScalarLaw<T>,
    },
    /// On a body.
    Body {
        /// The body.
        body: BodyId,
        /// Point, reference configuration [m].
        at: [T; 3],
        /// Direction, fixed in the body.
        axis: [T; 3],
        /// The law.
        law: UserBodyLaw<T>,
    },
}

/// One polynomial and the range in which it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct PolynomialPiece<T> {
    /// Where it begins [m or m/s].
    pub lower: T,
    /// Where it ends [m or m/s].
    pub upper: T,
    /// Coefficients of increasing power, at most [`PolynomialPiece::MAX_COEFFICIENTS`].
    pub coefficients: Vec<T>,
}

impl<T> PolynomialPiece<T> {
    /// Largest number of coefficients of a piece: degree 7.
    pub const MAX_COEFFICIENTS: usize = 8;
}

pub use crate::laws::calspan::Coefficients as CalspanCoefficients;

/// The road under the tires: heights over the x axis, the same across it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Road<T> {
    /// Under wheels whose centre has y >= 0 in the reference configuration: features whose heights add up.
    pub left: Vec<RoadFeature<T>>,
    /// Under the others.
    pub right: Vec<RoadFeature<T>>,
    /// Speed at which the road comes towards a standing vehicle, along -x [m/s].
    pub speed: T,
}

/// A part of a road; heights of all parts add up.
#[derive(Debug, Clone, PartialEq)]
pub enum RoadFeature<T> {
    /// The same height everywhere [m].
    Flat {
        /// Height [m].
        height: T,
    },
    /// A rise (or fall) of constant slope with rounded corners, level before and after: a ramp; short: a step of stairs.
    Rise {
        /// Where it begins [m].
        start: T,
        /// Its length along x [m].
        length: T,
        /// Its height; negative: down [m].
        height: T,
        /// Length of each rounded corner, at most half the length [m].
        rounding: T,
    },
    /// amplitude (1 - cos(2 pi (x - start) / length)), once.
    Bump {
        /// Where it begins [m].
        start: T,
        /// Its length along x [m].
        length: T,
        /// Half its height; negative: a hole [m].
        amplitude: T,
    },
    /// Natural cubic spline through (x, z), level outside.
    Table(Vec<[T; 2]>),
}
