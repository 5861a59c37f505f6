//! What a scene says, as the judge reads it. A planar scene lies in the plane z = 0 of space.

pub use crate::parts::{
    Carrier, Coupling, Curve, Given, Law, Measure, Rolling, Seat, Shape, Signal, Source, Spline,
    Term, Wheel,
};
use crate::vector::{Matrix, Vector};

/// A scene.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Is it planar?
    pub planar: bool,
    /// Gravity [m/s²].
    pub gravity: Vector,
    /// Duration [s].
    pub duration: f64,
    /// Step that the scene asks for [s].
    pub step: Option<f64>,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Couplings.
    pub couplings: Vec<Coupling>,
    /// Turns that couplings count, beside those of joints.
    pub wheels: Vec<Wheel>,
    /// What rolls.
    pub rollings: Vec<Rolling>,
    /// Guides.
    pub guides: Vec<Guide>,
    /// What is held at the start.
    pub initials: Vec<InitialCondition>,
    /// Signals.
    pub signals: Vec<Signal>,
    /// Effects that are enabled.
    pub effects: Vec<Effect>,
    /// The road's features: left and right.
    pub road: [Vec<Feature>; 2],
    /// Speed of the road along -x [m/s].
    pub road_speed: f64,
    /// Channels.
    pub outputs: Vec<Output>,
}

/// A body in the reference configuration.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass [m].
    pub center: Vector,
    /// Inertia about the centre of mass, global axes [kg m²].
    pub inertia: Matrix,
    /// Factor of gravity.
    pub gravity_scale: f64,
}

/// The kinds of joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// One rotation.
    Revolute,
    /// Three rotations.
    Spherical,
    /// Two rotations.
    Universal,
    /// One translation.
    Prismatic,
    /// A translation and a rotation along one axis.
    Cylindrical,
    /// Two translations and a rotation across them.
    Planar,
    /// Nothing moves.
    Weld,
    /// Everything moves.
    Free,
    /// Two points keep their distance.
    Distance,
}

/// A joint.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: Kind,
    /// First and second body.
    pub bodies: [Carrier; 2],
    /// Its point in both bodies [m].
    pub points: [Vector; 2],
    /// Unit axes: axis, and direction or second axis.
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

    /// How many of its coordinates are translations, which come first, and how many rotations.
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

/// A guided joint.
#[derive(Debug, Clone)]
pub struct Guide {
    /// The joint.
    pub joint: usize,
    /// The number of its coordinate.
    pub coordinate: usize,
    /// That coordinate over time.
    pub law: Law,
}

/// What is held at the start.
#[derive(Debug, Clone)]
pub enum InitialCondition {
    /// Coordinates and rates of a joint.
    Joint {
        /// The joint.
        joint: usize,
        /// Its coordinates.
        value: Option<Vec<f64>>,
        /// Their rates.
        rate: Option<Vec<f64>>,
    },
    /// Velocities of a body.
    Body {
        /// The body.
        body: usize,
        /// Velocity of a point.
        velocity: Option<[Vector; 2]>,
        /// Angular velocity.
        angular: Option<Vector>,
    },
}

/// Two points, one a body.
#[derive(Debug, Clone)]
pub struct Line {
    /// First and second body.
    pub bodies: [Carrier; 2],
    /// Their points.
    pub points: [Vector; 2],
    /// Measured along this direction of the first body.
    pub direction: Option<Vector>,
}

/// Side force of a tire by the Calspan model: a, omega, b, skid, trail.
#[derive(Debug, Clone)]
pub struct Calspan {
    /// A0 to A4.
    pub a: [f64; 5],
    /// W.
    pub omega: f64,
    /// B1, B3, B4.
    pub b: [f64; 3],
    /// k.
    pub skid: f64,
    /// AF1, AF2.
    pub trail: [f64; 2],
}

/// An effect.
#[derive(Debug, Clone)]
pub enum Effect {
    /// Stiffness, damping, free length.
    SpringDamper(Line, [f64; 3]),
    /// Pieces [lower, upper, c0, ...] of the length, or of its rate.
    Polynomial(Line, Vec<Vec<f64>>, bool),
    /// Stiffness, damping, clearance.
    Bumper(Line, [f64; 3]),
    /// A force along the line.
    Actuator(Line, Given),
    /// Stiffness and damping along and about the axes of the first body.
    Bushing([Carrier; 2], Vector, [[f64; 6]; 2]),
    /// Sum; stiffness, damping, free value.
    TorsionSpring(Vec<Term>, [f64; 3]),
    /// Torque of a joint's first body on its second, or along a sum.
    JointTorque(Vec<Term>, Given),
    /// Torque on a body.
    BodyTorque(usize, Given),
    /// Sum; lower, upper, stiffness, damping.
    Limit(Vec<Term>, [f64; 4]),
    /// Sum; coulomb, static, stribeck, viscous, regularisation.
    Friction(Vec<Term>, [f64; 5]),
    /// Body, point, force; does it turn with the body?
    Force(usize, Vector, Given, bool),
    /// Body, point; area times coefficient, density.
    Drag(usize, Vector, [f64; 2]),
    /// Body, direction; speed, gain, limit.
    SpeedHold(usize, Vector, [f64; 3]),
    /// A wheel.
    Tire(Tire),
    /// Joint; the rotor's inertia times the square of its ratio.
    Rotor(usize, f64),
}

impl Shape {
    /// Its kind in scene files.
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
    /// Its kind in scene files.
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
    /// Its kind in scene files, with where it acts.
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
    /// Its carrier.
    pub body: usize,
    /// Its centre.
    pub center: Vector,
    /// Its axis.
    pub axis: Option<Vector>,
    /// Radius, stiffness, damping, rolling resistance.
    pub numbers: [f64; 4],
    /// Side force.
    pub side: Option<Calspan>,
}

/// A part of the road.
#[derive(Debug, Clone)]
pub enum Feature {
    /// Height.
    Flat(f64),
    /// Start, length, height, rounding.
    Ramp([f64; 4]),
    /// Start, length, amplitude.
    Bump([f64; 3]),
    /// Natural cubic spline of the height.
    Table(Spline),
}

/// A channel.
#[derive(Debug, Clone)]
pub struct Output {
    /// Its name.
    pub name: String,
    /// What it shows.
    pub quantity: Quantity,
}

/// What a channel shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// Of a body's point.
    Position(usize, Vector),
    /// Of a body's point.
    Velocity(usize, Vector),
    /// Of a body's point.
    Acceleration(usize, Vector),
    /// Of a body's point: its acceleration without gravity.
    ProperAcceleration(usize, Vector),
    /// Of a body.
    AngularVelocity(usize),
    /// Of a body.
    AngularAcceleration(usize),
    /// Of a body: the angle in the plane, a quaternion in space.
    Orientation(usize),
    /// Of a body: the angle in the plane.
    RotationVector(usize),
    /// Of a body, row by row.
    RotationMatrix(usize),
    /// Of a body.
    KineticEnergy(usize),
    /// Of a joint.
    Value(usize),
    /// Of a joint.
    Rate(usize),
    /// Of a joint.
    JointAcceleration(usize),
    /// Of a joint: what its guide puts on its coordinate.
    Effort(usize),
    /// Of a joint: what its guide gives through it.
    Power(usize),
    /// Of a joint.
    Reaction(usize),
    /// Of a coupling.
    Coupling(usize, Coupled),
    /// Of a signal: its value, or its rate.
    Signal(usize, bool),
    /// Of what rolls: the force on it at the contact.
    Contact(usize),
    /// Of a body against another one, global axes.
    RelativeAngularVelocity(usize, usize),
    /// Of the scene: kinetic and stored.
    Energy,
}

/// What a channel shows of a coupling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coupled {
    /// What its drawn part feels.
    Effort,
    /// Its sum.
    Value,
    /// The length of its lines.
    Length,
    /// The rate of its sum.
    Rate,
    /// What it gives or passes on.
    Power,
}
