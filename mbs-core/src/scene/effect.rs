//! Data of effects: signals, axes, user-defined laws, polynomials and roads.

use crate::laws::user::{UserBodyLaw, UserScalarLaw};
use crate::scene::{BodyId, CurveShape, JointId, SignalId};
use alloc::vec::Vec;

/// Signal of an effect: a constant, a table over time, or signals of the scene. Tables are linear between their points, and the end
/// values are held outside.
#[derive(Debug, Clone, PartialEq)]
pub enum Signal<T> {
    /// Constant vector for all times. Planar torques and joint torques use the first component only.
    Constant([T; 3]),
    /// Rows of (time, value).
    Table(Vec<(T, [T; 3])>),
    /// Input whose value is held until it is set between steps. This is the value at the start.
    Input([T; 3]),
    /// Signals of the scene, one for each component. Trailing components that are not needed may be left out.
    Named([Option<SignalId>; 3]),
}

/// Axes in which a force is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisFrame {
    /// Global axes, whose directions are fixed.
    Global,
    /// Axes that rotate with the body. They are the global axes in the reference configuration.
    Body,
}

/// User-defined law, with the place at which it acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum UserLaw<T> {
    /// Law along the line between two body points.
    Length {
        /// First and second body.
        bodies: [BodyId; 2],
        /// One point per body, reference configuration [m].
        points: [[T; 3]; 2],
        /// User's law of the line.
        law: UserScalarLaw<T>,
    },
    /// Law on the coordinate of a joint that has one coordinate.
    Joint {
        /// Joint on which the law acts.
        joint: JointId,
        /// User's law of the coordinate.
        law: UserScalarLaw<T>,
    },
    /// Law on a body at a point.
    Body {
        /// Body on which the law acts.
        body: BodyId,
        /// Point of the body, reference configuration [m].
        at: [T; 3],
        /// Direction that is fixed in the body.
        axis: [T; 3],
        /// User's law of the body.
        law: UserBodyLaw<T>,
    },
}

/// Polynomial with the range in which it holds.
#[derive(Debug, Clone, PartialEq)]
pub struct PolynomialPiece<T> {
    /// Beginning of the range [m or m/s].
    pub lower: T,
    /// End of the range [m or m/s].
    pub upper: T,
    /// Coefficients by increasing power, at most [`PolynomialPiece::MAX_COEFFICIENTS`].
    pub coefficients: Vec<T>,
}

impl<T> PolynomialPiece<T> {
    /// Largest number of coefficients of a piece, which gives degree 7.
    pub const MAX_COEFFICIENTS: usize = crate::laws::polynomial::MAX_COEFFICIENTS;
}

pub use crate::laws::calspan::Coefficients as CalspanCoefficients;
pub use crate::laws::slip::LongitudinalSlip;

/// Road under the tires: heights over the x axis, constant across it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Road<T> {
    /// Road under wheels whose centre has y >= 0 in the reference configuration. The heights of all features add up.
    pub left: Vec<RoadFeature<T>>,
    /// Road under the other wheels. In the plane both sides have the same features.
    pub right: Vec<RoadFeature<T>>,
    /// Speed with which the road moves along -x, towards a vehicle at rest [m/s].
    pub speed: T,
}

/// Feature of a road. The heights of all features add up.
#[derive(Debug, Clone, PartialEq)]
pub enum RoadFeature<T> {
    /// Level road with the same height everywhere.
    Flat {
        /// Height of the road [m].
        height: T,
    },
    /// Rise (or fall) of constant slope with rounded corners, level before and after. A long rise is a ramp, a short one a step of
    /// stairs.
    Rise {
        /// Beginning of the rise along x [m].
        start: T,
        /// Length of the rise along x [m].
        length: T,
        /// Height of the rise [m]; negative for a fall.
        height: T,
        /// Length of each rounded corner, at most half the length [m].
        rounding: T,
    },
    /// Stairs of risers, each followed by a tread. Riser i begins at start + i (tread + riser), and is rounded over all its length.
    Stairs {
        /// Beginning of the first riser along x [m].
        start: T,
        /// Length of a tread along x [m].
        tread: T,
        /// Length of a riser along x [m].
        riser: T,
        /// Height of a riser [m]; negative for stairs that lead down.
        height: T,
        /// Number of risers of the stairs.
        count: u32,
    },
    /// Single bump: amplitude (1 - cos(2 pi (x - start) / length)).
    Bump {
        /// Beginning of the bump along x [m].
        start: T,
        /// Length of the bump along x [m].
        length: T,
        /// Half the height of the bump [m]; negative for a hole.
        amplitude: T,
    },
    /// Natural cubic spline through points (x, z), level outside.
    Table(Vec<[T; 2]>),
    /// Points (x, z) connected by another shape than a spline, level outside. Roads under tires must not be linear between their
    /// points.
    Shaped {
        /// Points (x, z) of the road [m].
        points: Vec<[T; 2]>,
        /// Shape of the road between the points.
        shape: CurveShape,
    },
}
