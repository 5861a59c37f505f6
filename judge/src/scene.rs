//! Scene as the judge reads it. A planar scene lies in the plane z = 0 of space.

pub use crate::parts::{
    Carrier, Coupling, Curve, Given, Law, Measure, Rolling, Seat, Shape, Signal, Source, Spline,
    Term, Wheel,
};
use crate::vector::{Matrix, Vector};

/// Scene that the judge runs.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// Is the scene planar?
    pub planar: bool,
    /// Acceleration of gravity [m/s²].
    pub gravity: Vector,
    /// Duration of the run [s].
    pub duration: f64,
    /// Step that the scene asks for [s].
    pub step: Option<f64>,
    /// Bodies of the scene.
    pub bodies: Vec<Body>,
    /// Joints of the scene.
    pub joints: Vec<Joint>,
    /// Couplings of the scene.
    pub couplings: Vec<Coupling>,
    /// Turns that couplings count, beside those of joints.
    pub wheels: Vec<Wheel>,
    /// Contacts that roll, and blades.
    pub rollings: Vec<Rolling>,
    /// Guides of coordinates of joints.
    pub guides: Vec<Guide>,
    /// Conditions that hold at the start.
    pub initials: Vec<InitialCondition>,
    /// Signals of the scene.
    pub signals: Vec<Signal>,
    /// Effects that are enabled.
    pub effects: Vec<Effect>,
    /// Features of the road: left and right.
    pub road: [Vec<Feature>; 2],
    /// Speed of the road along -x [m/s].
    pub road_speed: f64,
    /// Channels of the scene.
    pub outputs: Vec<Output>,
}

/// A body in the reference configuration.
#[derive(Debug, Clone)]
pub struct Body {
    /// Name of the body.
    pub name: String,
    /// Mass of the body [kg].
    pub mass: f64,
    /// Centre of mass [m].
    pub center: Vector,
    /// Inertia about the centre of mass, global axes [kg m²].
    pub inertia: Matrix,
    /// Factor of gravity on the body [-].
    pub gravity_scale: f64,
}

/// The kinds of joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// Joint with one rotation.
    Revolute,
    /// Joint with three rotations.
    Spherical,
    /// Joint with two rotations.
    Universal,
    /// Joint with one translation.
    Prismatic,
    /// Joint with a translation and a rotation along one axis.
    Cylindrical,
    /// Joint with two translations and a rotation across them.
    Planar,
    /// Joint in which nothing moves.
    Weld,
    /// Joint in which everything moves.
    Free,
    /// Joint in which two points keep their distance.
    Distance,
}

/// Joint between two bodies.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Name of the joint.
    pub name: String,
    /// Kind of the joint.
    pub kind: Kind,
    /// First and second body.
    pub bodies: [Carrier; 2],
    /// Point of the joint in both bodies [m].
    pub points: [Vector; 2],
    /// Unit vectors: axis, and direction or second axis.
    pub axes: [Vector; 2],
    /// A link of constant distance with a hinge at its first end.
    pub hinged: bool,
}

impl Kind {
    /// All of them, by their names in scene files.
    pub const NAMES: [(Self, &'static str); 9] = [
        (Self::Revolute, "revolute"),
        (Self::Spherical, "spherical"),
        (Self::Universal, "universal"),
        (Self::Prismatic, "prismatic"),
        (Self::Cylindrical, "cylindrical"),
        (Self::Planar, "planar"),
        (Self::Weld, "weld"),
        (Self::Free, "free"),
        (Self::Distance, "distance"),
    ];

    /// Number of translations among the joint's coordinates, which come first, and number of rotations.
    #[must_use]
    pub fn coordinates(self, planar: bool) -> [usize; 2] {
        match self {
            Self::Revolute => [0, 1],
            Self::Prismatic => [1, 0],
            Self::Cylindrical => [1, 1],
            Self::Universal => [0, 2],
            Self::Spherical => [0, 3],
            Self::Planar => [2, 1],
            Self::Free if planar => [2, 1],
            Self::Free => [3, 3],
            Self::Weld | Self::Distance => [0, 0],
        }
    }
}

/// Guide of a coordinate of a joint.
#[derive(Debug, Clone)]
pub struct Guide {
    /// Index of the joint.
    pub joint: usize,
    /// The number of its coordinate.
    pub coordinate: usize,
    /// Coordinate over time.
    pub law: Law,
}

/// Condition that holds at the start.
#[derive(Debug, Clone)]
pub enum InitialCondition {
    /// Coordinates and rates of a joint.
    Joint {
        /// Index of the joint.
        joint: usize,
        /// Coordinates of the joint.
        value: Option<Vec<f64>>,
        /// Rates of the coordinates.
        rate: Option<Vec<f64>>,
    },
    /// Velocities of a body.
    Body {
        /// Index of the body.
        body: usize,
        /// Velocity of a point.
        velocity: Option<[Vector; 2]>,
        /// Angular velocity of the body, global axes.
        angular: Option<Vector>,
    },
}

/// Two points, one a body.
#[derive(Debug, Clone)]
pub struct Line {
    /// First and second body.
    pub bodies: [Carrier; 2],
    /// Points of the line on the two bodies.
    pub points: [Vector; 2],
    /// Measured along this direction of the first body.
    pub direction: Option<Vector>,
}

/// Side force of a tire by the Calspan model: a, omega, b, skid, trail.
#[derive(Debug, Clone)]
pub struct Calspan {
    /// Coefficients A0 to A4.
    pub a: [f64; 5],
    /// Factor W of A2.
    pub omega: f64,
    /// Coefficients B1, B3, B4 of the friction.
    pub b: [f64; 3],
    /// Factor k of the friction.
    pub skid: f64,
    /// Coefficients AF1, AF2 of the trail.
    pub trail: [f64; 2],
}

/// Effect that is enabled, with its numbers.
#[derive(Debug, Clone)]
pub enum Effect {
    /// Spring and damper: stiffness, damping, free length.
    SpringDamper(Line, [f64; 3]),
    /// Pieces [lower, upper, c0, ...] of the length, or of its rate.
    Polynomial(Line, Vec<Vec<f64>>, bool),
    /// Bumper: stiffness, damping, clearance.
    Bumper(Line, [f64; 3]),
    /// A force along the line.
    Actuator(Line, Given),
    /// Stiffness and damping along and about the axes of the first body.
    Bushing([Carrier; 2], Vector, [[f64; 6]; 2]),
    /// Torsion spring on a sum: stiffness, damping, free value.
    TorsionSpring(Vec<Term>, [f64; 3]),
    /// Torque of a joint's first body on its second, or along a sum.
    JointTorque(Vec<Term>, Given),
    /// Torque on a body.
    BodyTorque(usize, Given),
    /// Limit of a sum: lower, upper, stiffness, damping.
    Limit(Vec<Term>, [f64; 4]),
    /// Friction along a sum: coulomb, static, stribeck, viscous, regularisation.
    Friction(Vec<Term>, [f64; 5]),
    /// Force on a body: body, point, force; does it turn with the body?
    Force(usize, Vector, Given, bool),
    /// Drag on a body: body, point; area times coefficient, density.
    Drag(usize, Vector, [f64; 2]),
    /// Force that holds a body's speed: body, direction; speed, gain, limit.
    SpeedHold(usize, Vector, [f64; 3]),
    /// Wheel on the road.
    Tire(Tire),
    /// Rotor on a joint: joint; the rotor's inertia times the square of its ratio.
    Rotor(usize, f64),
}

impl Shape {
    /// Returns the kind of the shape in scene files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Disc(..) => "wheel",
            Self::Ball(_) => "ball",
            Self::Blade(_) => "blade",
        }
    }
}

impl Source {
    /// Returns the kind of the source in scene files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Constant(_) => "constant",
            Self::Table(_) => "table",
            Self::Sine(_) => "sine",
            Self::Chirp(_) => "chirp",
            Self::Ramp(_) => "ramp",
            Self::Step(_) => "step",
            Self::Sum(_) => "sum",
            Self::Product(_) => "product",
            Self::Of(..) => "curve",
            Self::Clamp(..) => "clamp",
            Self::LimitRatio(..) => "limit-ratio",
            Self::Measure(..) => "measure",
            Self::Lag(..) => "lag",
            Self::Integral(..) => "integral",
            Self::Pid(..) => "pid",
        }
    }
}

impl Effect {
    /// Returns the kind of the effect in scene files, with where it acts.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::SpringDamper(..) => "spring-damper",
            Self::Polynomial(_, _, false) => "polynomial-spring",
            Self::Polynomial(_, _, true) => "polynomial-damper",
            Self::Bumper(..) => "bumper",
            Self::Actuator(..) => "actuator",
            Self::Bushing(..) => "bushing",
            Self::TorsionSpring(..) => "torsion-spring",
            Self::JointTorque(..) => "torque on a joint",
            Self::BodyTorque(..) => "torque on a body",
            Self::Rotor(..) => "rotor",
            Self::Limit(..) => "limit",
            Self::Friction(..) => "friction",
            Self::Force(..) => "force",
            Self::Drag(..) => "aero-drag",
            Self::SpeedHold(..) => "speed-hold",
            Self::Tire(tire) if tire.side.is_some() => "tire with side force",
            Self::Tire(..) => "tire",
        }
    }
}

/// A wheel on the road.
#[derive(Debug, Clone)]
pub struct Tire {
    /// Carrier of the wheel.
    pub body: usize,
    /// Centre of the wheel.
    pub center: Vector,
    /// Axis of the wheel.
    pub axis: Option<Vector>,
    /// Radius, stiffness, damping, rolling resistance.
    pub numbers: [f64; 4],
    /// Side force of the tire.
    pub side: Option<Calspan>,
}

/// A part of the road.
#[derive(Debug, Clone)]
pub enum Feature {
    /// Flat part: its height.
    Flat(f64),
    /// Ramp: start, length, height, rounding.
    Ramp([f64; 4]),
    /// Bump: start, length, amplitude.
    Bump([f64; 3]),
    /// Natural cubic spline of the height.
    Table(Spline),
}

/// Channel of the outputs.
#[derive(Debug, Clone)]
pub struct Output {
    /// Name of the channel.
    pub name: String,
    /// Quantity that the channel shows.
    pub quantity: Quantity,
}

/// Quantity that a channel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Position of a body's point.
    Position(usize, Vector),
    /// Velocity of a body's point.
    Velocity(usize, Vector),
    /// Acceleration of a body's point.
    Acceleration(usize, Vector),
    /// Acceleration of a body's point without gravity.
    ProperAcceleration(usize, Vector),
    /// Angular velocity of a body.
    AngularVelocity(usize),
    /// Angular acceleration of a body.
    AngularAcceleration(usize),
    /// Orientation of a body: the angle in the plane, a quaternion in space.
    Orientation(usize),
    /// Rotation vector of a body; in the plane, the angle.
    RotationVector(usize),
    /// Rotation matrix of a body, row by row.
    RotationMatrix(usize),
    /// Kinetic energy of a body.
    KineticEnergy(usize),
    /// Coordinates of a joint.
    Value(usize),
    /// Rates of a joint's coordinates.
    Rate(usize),
    /// Second derivatives of a joint's coordinates.
    JointAcceleration(usize),
    /// Effort of a joint's guide on its coordinate.
    Effort(usize),
    /// Power that a joint's guide gives through it.
    Power(usize),
    /// Reaction of a joint.
    Reaction(usize),
    /// Quantity of a coupling.
    Coupling(usize, Coupled),
    /// Value of a signal, or its rate.
    Signal(usize, bool),
    /// Force at the contact on a body that rolls, or on a blade.
    Contact(usize),
    /// Angular velocity of a body against another one, global axes.
    RelativeAngularVelocity(usize, usize),
    /// Energy of the scene: kinetic and stored.
    Energy,
}

/// Quantity of a coupling that a channel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coupled {
    /// Effort on the coupling's drawn part.
    Effort,
    /// Value of the coupling's sum.
    Value,
    /// Length of the coupling's lines.
    Length,
    /// Rate of the coupling's sum.
    Rate,
    /// Power that the coupling gives or passes on.
    Power,
}
