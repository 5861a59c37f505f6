//! Data that describe effects: signals, axes, laws of users, polynomials and roads.

use crate::laws::user::{UserBodyLaw, UserScalarLaw};
use crate::scene::{BodyId, CurveShape, JointId, SignalId};
use alloc::vec::Vec;

/// A constant, a table over time (linear between the points, the end values held outside), or signals of the scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Signal<T> {
    /// Vector that is the same at all times; planar torques and joint torques use the first component only.
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
    /// Global axes, whose directions are fixed.
    Global,
    /// Turning with the body (global axes of the reference configuration at the start).
    Body,
}

/// Law of a user's own, with the place where it acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UserLaw<T> {
    /// Along the line of two body points.
    Length {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// User's law of the line.
        law: UserScalarLaw<T>,
    },
    /// On the coordinate of a joint that has one.
    Joint {
        /// Joint on which the law acts.
        joint: JointId,
        /// User's law of the coordinate.
        law: UserScalarLaw<T>,
    },
    /// On a body at a point.
    Body {
        /// Body on which the law acts.
        body: BodyId,
        /// Point, reference configuration [m].
        at: [T; 3],
        /// Direction, fixed in the body.
        axis: [T; 3],
        /// User's law of the body.
        law: UserBodyLaw<T>,
    },
}

/// One polynomial and the range in which it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct PolynomialPiece<T> {
    /// Beginning of the range [m or m/s].
    pub lower: T,
    /// End of the range [m or m/s].
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
    /// Under the other wheels; in the plane the same features.
    pub right: Vec<RoadFeature<T>>,
    /// Speed at which the road comes towards a standing vehicle, along -x [m/s].
    pub speed: T,
}

/// A part of a road; heights of all parts add up.
#[derive(Debug, Clone, PartialEq)]
pub enum RoadFeature<T> {
    /// Level road of one height everywhere.
    Flat {
        /// Height of the road [m].
        height: T,
    },
    /// A rise (or fall) of constant slope with rounded corners, level before and after: a ramp; short: a step of stairs.
    Rise {
        /// Beginning of the rise along x [m].
        start: T,
        /// Length of the rise along x [m].
        length: T,
        /// Height of the rise; negative: down [m].
        height: T,
        /// Length of each rounded corner, at most half the length [m].
        rounding: T,
    },
    /// Risers, each with a tread behind it: rise i begins at start + i (tread + riser). A riser is all rounding, without a straight part.
    Stairs {
        /// Beginning of the first riser along x [m].
        start: T,
        /// Length of a tread along x [m].
        tread: T,
        /// Length of a riser along x [m].
        riser: T,
        /// Height of a riser; negative: down [m].
        height: T,
        /// Number of risers of the stairs.
        count: u32,
    },
    /// amplitude (1 - cos(2 pi (x - start) / length)), once.
    Bump {
        /// Beginning of the bump along x [m].
        start: T,
        /// Length of the bump along x [m].
        length: T,
        /// Half the height of the bump; negative: a hole [m].
        amplitude: T,
    },
    /// Natural cubic spline through (x, z), level outside.
    Table(Vec<[T; 2]>),
    /// Through (x, z) without a spline, level outside. Under tires none is straight between its points.
    Shaped {
        /// The points (x, z).
        points: Vec<[T; 2]>,
        /// Shape of the road between the points.
        shape: CurveShape,
    },
}
