//! What effects are described by: signals, axes, laws of users, polynomials and roads.

use crate::laws::user::{UserBodyLaw, UserScalarLaw};
use crate::scene::{BodyId, CurveShape, JointId, SignalId};
use alloc::vec::Vec;

/// A constant, a table over time (linear between the points, the end values held outside), or signals of the scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Signal<T> {
    /// The same at all times; planar torques and joint torques use the first component only.
    Constant([T; 3]),
    /// Rows of (time, value).
    Table(Vec<(T, [T; 3])>),
    /// Held until it is set again between steps; this at the start.
    Input([T; 3]),
    /// Signals of the scene, one for each component; the last ones may be left out where none is needed.
    Named([Option<SignalId>; 3]),
}

/// Axes in which a force is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisFrame {
    /// Fixed directions.
    Global,
    /// Turning with the body (global axes of the reference configuration at the start).
    Body,
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
    /// Most coefficients of a piece: degree 7.
    pub const MAX_COEFFICIENTS: usize = crate::laws::polynomial::MAX_COEFFICIENTS;
}

pub use crate::laws::calspan::Coefficients as CalspanCoefficients;
pub use crate::laws::slip::LongitudinalSlip;

/// The road under the tires: heights over the x axis, the same across it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Road<T> {
    /// Under wheels whose centre has y >= 0 in the reference configuration: features whose heights add up.
    pub left: Vec<RoadFeature<T>>,
    /// Under the others; in the plane the same.
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
    /// Risers, each with a tread behind it: rise i begins at start + i (tread + riser). A riser is all rounding, without a straight part.
    Stairs {
        /// Where the first riser begins [m].
        start: T,
        /// Length of a tread along x [m].
        tread: T,
        /// Length of a riser along x [m].
        riser: T,
        /// Height of a riser; negative: down [m].
        height: T,
        /// Number of risers.
        count: u32,
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
    /// Through (x, z) without a spline, level outside. Under tires none is straight between its points.
    Shaped {
        /// The points (x, z).
        points: Vec<[T; 2]>,
        /// How it goes between them.
        shape: CurveShape,
    },
}
