//! Scene as the judge reads it. A planar scene is treated as one in space, in the plane z = 0.

pub use crate::effect::{Calspan, Effect, Line, Path, Tire};
pub use crate::parts::{
    Carrier, Coupling, Curve, Given, Law, Measure, Rolling, Seat, Shape, Signal, Source, Spline,
    Term, Wheel,
};
pub use crate::quantity::{Coupled, Exerts, Leaning, Output, Quantity, Relative, Seen, Whole};
use crate::vector::{Matrix, Vector};

/// Scene that the judge runs.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Name of the scene.
    pub name: String,
    /// True if the scene is planar.
    pub planar: bool,
    /// Acceleration of gravity [m/s²].
    pub gravity: Vector,
    /// Duration of the run [s].
    pub duration: f64,
    /// Step that the scene gives [s].
    pub step: Option<f64>,
    /// Bodies of the scene.
    pub bodies: Vec<Body>,
    /// Joints of the scene.
    pub joints: Vec<Joint>,
    /// Couplings of the scene.
    pub couplings: Vec<Coupling>,
    /// Relative rotations that couplings measure, besides the coordinates of joints.
    pub wheels: Vec<Wheel>,
    /// Contacts of bodies that roll, and of blades.
    pub rollings: Vec<Rolling>,
    /// Guides of coordinates of joints.
    pub guides: Vec<Guide>,
    /// Guides of rotation vectors of joints.
    pub guided_turns: Vec<GuidedTurn>,
    /// Conditions that hold at the start.
    pub initials: Vec<InitialCondition>,
    /// Signals of the scene.
    pub signals: Vec<Signal>,
    /// Effects that are enabled.
    pub effects: Vec<Effect>,
    /// Names of the enabled effects.
    pub effect_names: Vec<String>,
    /// Limits without a given stiffness or damping, which follows from the mass that the coordinate moves. Each has the index of its
    /// effect, and true where stiffness and damping are not given.
    pub open_limits: Vec<(usize, [bool; 2])>,
    /// Features of the road under the left and under the right wheels.
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
    /// Joint with two translations and a rotation about their common normal.
    Planar,
    /// Joint with a translation and three rotations; in the plane with one translation and one rotation.
    PinInSlot,
    /// Joint without any freedom.
    Weld,
    /// Joint with all freedoms.
    Free,
    /// Joint with all translations, for a body that is a point and has no orientation.
    FreePoint,
    /// Joint that keeps two points at a constant distance.
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
    /// Unit vectors: the axis of the joint; its direction or second axis.
    pub axes: [Vector; 2],
    /// True if the joint is a link of constant distance with a hinge at its first end.
    pub hinged: bool,
    /// Least and largest value of the coordinate, for kinds with one coordinate.
    pub range: Option<[f64; 2]>,
}

impl Kind {
    /// Kinds that scene files name.
    pub const NAMES: [(Self, &'static str); 10] = [
        (Self::Revolute, "revolute"),
        (Self::Spherical, "spherical"),
        (Self::Universal, "universal"),
        (Self::Prismatic, "prismatic"),
        (Self::Cylindrical, "cylindrical"),
        (Self::Planar, "planar"),
        (Self::PinInSlot, "pin-in-slot"),
        (Self::Weld, "weld"),
        (Self::Free, "free"),
        (Self::Distance, "distance"),
    ];

    /// Numbers of translations and of rotations among the joint's coordinates. The translations come first.
    #[must_use]
    pub fn coordinates(self, planar: bool) -> [usize; 2] {
        match self {
            Self::Revolute => [0, 1],
            Self::Prismatic => [1, 0],
            Self::Cylindrical => [1, 1],
            Self::Universal => [0, 2],
            Self::Spherical => [0, 3],
            Self::Planar => [2, 1],
            Self::PinInSlot if planar => [1, 1],
            Self::PinInSlot => [1, 3],
            Self::Free if planar => [2, 1],
            Self::Free => [3, 3],
            Self::FreePoint if planar => [2, 0],
            Self::FreePoint => [3, 0],
            Self::Weld | Self::Distance => [0, 0],
        }
    }
}

/// Guide of a coordinate of a joint.
#[derive(Debug, Clone)]
pub struct Guide {
    /// Index of the joint.
    pub joint: usize,
    /// The number of the guided coordinate.
    pub coordinate: usize,
    /// Coordinate over time.
    pub law: Law,
}

/// Guide of the rotation vector of a joint.
#[derive(Debug, Clone)]
pub struct GuidedTurn {
    /// Index of the joint.
    pub joint: usize,
    /// Components of the rotation vector over time.
    pub laws: [Law; 3],
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
