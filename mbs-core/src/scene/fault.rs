//! Faults that a scene can have, and what to do about them.

use super::{BodyId, NotDrawn, NotStrands};
use crate::joint::{Dimension, JointKind};
use crate::laws::relation::RelationFault;
use crate::scene::SignalBreak;
use core::fmt::{self, Display, Formatter};

/// Faults of a scene.
///
/// Each reads as the rest of a sentence about a key: `{}` says what is wrong and what to do, `{:#}` only
/// what is wrong; [`SceneFault::advice`] is the other half.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SceneFault {
    /// A number is infinite or NaN.
    NotFinite,
    /// A number must be positive; the number.
    NotPositive(f64),
    /// A number must not be negative; the number.
    Negative(f64),
    /// An axis has no direction.
    ZeroAxis,
    /// The two axes of a joint are parallel.
    ParallelAxes,
    /// A rod's ends, or the points of a distance joint or spring, coincide.
    CoincidentPoints,
    /// The two points of a joint that has one place differ (scenes built in code).
    PointsDiffer,
    /// A name is used twice; the index of the first use.
    DuplicateName(usize),
    /// The name is that of a body; its index.
    NameOfBody(usize),
    /// A name is empty, or is `ground` (a body) or `t` (an output).
    ReservedName,
    /// An index points to nothing (scenes built in code).
    UnknownReference,
    /// The ground, where only a body can stand.
    NeedsMovingBody,
    /// A law in code, where data is needed.
    InCode,
    /// One body twice, where two are needed.
    SameBody,
    /// Something that turns, or has an axis, of a point mass; the body.
    PointTurns(usize),
    /// A place that is not that of a point mass.
    OffPoint {
        /// Index of the body.
        body: usize,
        /// Distance of the two [m].
        by: f64,
    },
    /// A principal moment of inertia is larger than the sum of the other two; the two sides [kg m^2]. Of welded bodies together.
    TriangleInequality([f64; 2]),
    /// The inertia has a negative principal moment [kg m^2].
    NegativeInertia(f64),
    /// An inertia without mass.
    InertiaWithoutMass,
    /// The joint kind or key needs a spatial scene.
    NeedsSpatial,
    /// The form needs a planar scene.
    NeedsPlanar,
    /// A number must be from 0 to 1; the number.
    NotAShare(f64),
    /// A vector of a planar scene leaves the plane; the offending component.
    OutOfPlane(f64),
    /// The inertia's form does not fit the dimension.
    WrongDimension,
    /// The count of numbers is wrong.
    WrongCount {
        /// Count of numbers that is needed.
        needed: usize,
        /// Count of numbers that is there.
        found: usize,
    },
    /// The joint has no coordinates to speak about.
    NoCoordinate,
    /// The effect does not measure one number.
    NoMeasure,
    /// The effect acts on both sides: it has no contact.
    NoContact,
    /// The effect has neither a free value nor a gap: it has no deflection.
    NoDeflection,
    /// An output of a tire is of another effect.
    NotATire,
    /// An output without a vector has no magnitude and no axes.
    NoVector,
    /// An output without an angle has no unit of its own choice.
    NoAngle,
    /// The coordinate is not there; the number of coordinates that the joint has.
    UnknownCoordinate(usize),
    /// The coordinate is a component of a rotation, which is no angle of its own.
    BallCoordinate,
    /// The angle is one of a ball, which the joint has not.
    NoBall,
    /// A coupling has an angle of a ball.
    BallHeld,
    /// A twist of a ball that a signal measures.
    TwistMeasured,
    /// The coordinate of a joint that has several is missing, or is none of them.
    NeedsCoordinate {
        /// Kind of the joint.
        joint: JointKind,
        /// Dimension of the scene.
        dimension: Dimension,
        /// The number that is given.
        given: Option<usize>,
    },
    /// There is no term, or every factor is zero.
    NoTerm,
    /// A disc lies flat on the plane that it rolls on.
    LiesFlat,
    /// A blade stands along the plane's normal.
    AlongNormal,
    /// A wheel or ball does not touch its plane; the distance of its lowest point [m].
    Apart(f64),
    /// A periodic curve has different values at its ends; both.
    PeriodicEnds([f64; 2]),
    /// A table that is straight between its rows, where accelerations follow it.
    LinearTable,
    /// A pitch point of a coupling that is not of two turns about parallel axes in one body.
    NoMesh,
    /// A pretension of what has no strands.
    NotStrands(NotStrands),
    /// A pitch point that does not divide the way between the axes as the factors do; where it is [m].
    OffPitch([f64; 3]),
    /// The length of a coupling without lines.
    NoLine,
    /// A coupling that says that it is drawn, but is not.
    NotDrawn(NotDrawn),
    /// No body carries both parts of a drawn coupling.
    NoCarrier {
        /// The bodies that carry one each.
        bodies: [BodyId; 2],
        /// The joint about whose axis one would have to turn on the other.
        about: usize,
    },
    /// A pressure angle that is not from 0 to below a quarter turn [rad].
    PressureAngle(f64),
    /// The start values of its joints do not give the sum; what they give, and what is needed.
    SumAtStart([f64; 2]),
    /// The joint has no single coordinate to guide; the number it has.
    NoSingleCoordinate(usize),
    /// Guides of a joint are not one for each of its coordinates, in their order.
    GuideNotWhole {
        /// Number of coordinates of the joint.
        needed: usize,
        /// Number of guided coordinates, in their order.
        found: usize,
    },
    /// A guide between bodies that are welded together.
    GuideWelded,
    /// The joint has no single rotation to spring or drive; the number it has.
    NoSingleRotation(usize),
    /// One thing is prescribed twice; the index of the first entry.
    GivenTwice(usize),
    /// An initial entry contradicts the guide of its joint.
    Contradiction {
        /// Value that the entry gives.
        given: f64,
        /// Value that the guide gives at t = 0.
        guide: f64,
    },
    /// The table of a guide begins or ends on a slope within the run: an impact.
    TableSlope {
        /// The row (from 0).
        row: usize,
        /// The last one, not the first.
        is_end: bool,
        /// Time of the row [s].
        time: f64,
        /// The rate there [rad/s or m/s].
        rate: f64,
    },
    /// A signal is made of itself, directly or by others.
    SignalCircle,
    /// The signal is not smooth, which a guide or a coupling needs.
    SignalNotSmooth {
        /// Break at which the signal is not smooth.
        broken: SignalBreak,
        /// Remedy that makes the signal smooth.
        remedy: &'static str,
    },
    /// A controller needs the rate of a signal that has none which is known.
    SignalNoRate,
    /// Times in a table do not increase; the row (from 0) that is not later than the one before.
    TableOrder(usize),
    /// The upper limit is below the lower one; both.
    LimitOrder([f64; 2]),
    /// The lower end of a range is not below its upper end; both.
    RangeOrder([f64; 2]),
    /// A range, lower end first, has no number between its ends; both.
    EmptyRange([f64; 2]),
    /// The joint has no range that a limit could take.
    NoRange,
    /// A stiffness that follows from the mass that a coordinate moves, which nothing moves or which is guided.
    NoMovedMass,
    /// Static friction is less than Coulomb friction; both.
    StaticBelowCoulomb([f64; 2]),
    /// A polynomial has a piece without coefficients, or with too many.
    PieceCoefficients {
        /// The piece (from 0).
        piece: usize,
        /// Number of its coefficients.
        found: usize,
    },
    /// A piece of a polynomial (from 0) does not end above its beginning.
    PieceRange(usize),
    /// A piece of a polynomial (from 0) does not begin where the one before ends.
    PieceGap(usize),
    /// A wheel's joint does not join its body to another.
    SpinElsewhere,
    /// A wheel's joint turns about another axis than the wheel's.
    SpinAxis,
    /// A rotor on a joint that constrains nothing.
    FreeRotor,
    /// The inertia of a rotor at its joint is zero or no number; it [kg m^2 or kg].
    RotorRatio(f64),
    /// Coefficients of a tire that its formulas divide by.
    CalspanRange,
    /// Points of a road do not go forward; the point (from 0) that is not beyond the one before.
    PointOrder(usize),
    /// The rounded corners of a rise overlap [m].
    LongRounding {
        /// Length of a corner.
        rounding: f64,
        /// Half the length of the rise.
        most: f64,
    },
    /// A hollow of the road in which a wheel would touch twice; radii [m].
    TightHollow {
        /// Radius of the hollow at its tightest.
        hollow: f64,
        /// Radius of the largest wheel.
        wheel: f64,
    },
    /// A key that this kind needs is missing.
    Missing,
    /// A relation of a coupling that no step can take.
    Relation(RelationFault),
    /// A key that this kind does not use is there.
    NotUsed,
}

impl SceneFault {
    #[allow(clippy::too_many_lines, reason = "one sentence for each fault")]
    fn problem(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite => write!(f, "is infinite or not a number"),
            Self::NotPositive(x) => write!(f, "must be larger than zero, but is {x}"),
            Self::Negative(x) => write!(f, "must not be negative, but is {x}"),
            Self::ZeroAxis => write!(f, "has no direction: all components are zero"),
            Self::ParallelAxes => write!(f, "is parallel to the other axis"),
            Self::CoincidentPoints => write!(f, "has both points in the same place"),
            Self::PointsDiffer => write!(f, "has two different places"),
            Self::DuplicateName(i) => write!(f, "repeats the name of number {}", i + 1),
            Self::NameOfBody(i) => write!(f, "is the name of body {}, on which it is not", i + 1),
            Self::ReservedName => write!(f, "is empty or reserved"),
            Self::UnknownReference => write!(f, "points to something that is not in the scene"),
            Self::NeedsMovingBody => write!(f, "is the ground, which does not move"),
            Self::InCode => write!(f, "is a law in code, which has a precision of its own"),
            Self::SameBody => write!(f, "has the same body twice"),
            Self::PointTurns(body) => {
                write!(f, "is of body {}, a point: it has no orientation", body + 1)
            }
            Self::OffPoint { body, by } => {
                write!(f, "is {by:.6e} m off body {}, which is a point", body + 1)
            }
            Self::TriangleInequality([largest, sum]) => write!(
                f,
                "breaks the triangle inequality: the largest principal moment {largest:.3e} is more \
                 than the sum {sum:.3e} of the other two"
            ),
            Self::NegativeInertia(x) => write!(f, "has the negative principal moment {x:.3e}"),
            Self::InertiaWithoutMass => write!(f, "is not zero, but the body has no mass"),
            Self::NeedsSpatial => write!(f, "needs a spatial scene"),
            Self::NeedsPlanar => write!(f, "needs a planar scene"),
            Self::NotAShare(x) => write!(f, "must be from 0 to 1, but is {x}"),
            Self::OutOfPlane(x) => write!(f, "leaves the plane of a planar scene by {x}"),
            Self::WrongDimension => write!(f, "does not fit the dimension of the scene"),
            Self::WrongCount { needed, found } => {
                let plural = if *needed == 1 { "" } else { "s" };
                write!(f, "needs {needed} number{plural}, but has {found}")
            }
            Self::NoCoordinate => write!(f, "is a joint without coordinates"),
            Self::NoMeasure => write!(
                f,
                "is not measured by this effect, which acts on bodies in several directions"
            ),
            Self::NoContact => write!(f, "is not known of this effect, which acts on both sides"),
            Self::NotATire => write!(f, "is of tires alone"),
            Self::NoVector => {
                write!(f, "the quantity has no vector, and so no magnitude and no axes")
            }
            Self::NoAngle => write!(f, "is of angles, their rates and their accelerations alone"),
            Self::NoDeflection => {
                write!(f, "is not known of this effect, which has neither a free value nor a gap")
            }
            Self::UnknownCoordinate(n) => {
                write!(
                    f,
                    "is not there: the joint has {n} coordinate{}",
                    if *n == 1 { "" } else { "s" }
                )
            }
            Self::NeedsCoordinate { joint, dimension, given } => {
                match given {
                    Some(number) => write!(f, "is {number}, but the joint has")?,
                    None => write!(f, "is missing: the joint has")?,
                }
                for (i, (_, name)) in joint.coordinate_names(*dimension).enumerate() {
                    write!(f, "{} `{name}`", if i == 0 { "" } else { "," })?;
                }
                Ok(())
            }
            Self::BallCoordinate => write!(f, "is a component of a rotation, not an angle"),
            Self::NoBall => write!(f, "is an angle of a ball, which the joint has not"),
            Self::TwistMeasured => write!(f, "has no value where the swing is half a turn"),
            Self::BallHeld => write!(f, "has an angle of a ball, which no coupling holds"),
            Self::NoTerm => write!(f, "has no term with a factor that is not zero"),
            Self::LiesFlat => write!(f, "is along the plane's normal: the disc lies flat"),
            Self::AlongNormal => write!(f, "is along the plane's normal"),
            Self::Apart(gap) => {
                write!(f, "does not touch: the lowest point is {gap:.6e} m above the plane")
            }
            Self::NoMesh => {
                write!(f, "is for two wheels on one body that turn about parallel axes")
            }
            Self::NotStrands(NotStrands::Wheels) => {
                write!(f, "is for a belt on two wheels that turn about parallel axes in one body")
            }
            Self::NotStrands(NotStrands::Planes(apart)) => write!(
                f,
                "needs both wheels in one plane, but their joints stand {apart:.6e} m apart along the axes"
            ),
            Self::NotStrands(NotStrands::Inside(distance)) => write!(
                f,
                "needs strands, but the axes are {distance:.6e} m apart, too near for wheels of these radii"
            ),
            Self::OffPitch([x, y, z]) => write!(
                f,
                "is not where wheels with these factors touch, which is at [{x}, {y}, {z}]"
            ),
            Self::NoLine => {
                write!(f, "is of couplings with lines over points, which this one has not")
            }
            Self::NotDrawn(NotDrawn::Parallel) => {
                write!(f, "has axes that are not parallel: what is drawn gives them no sense")
            }
            Self::NotDrawn(NotDrawn::PitchLine) => write!(
                f,
                "has its rack on the pinion's axis: what is drawn does not say on which side its pitch line is"
            ),
            Self::NoCarrier { about, .. } => write!(
                f,
                "leads from two bodies, of which none turns on the other about the axis of joint {}: no body carries both axes",
                about + 1
            ),
            Self::PressureAngle(angle) => {
                write!(f, "is {angle} rad, but must be from 0 to below a quarter turn")
            }
            Self::PeriodicEnds([first, last]) => {
                write!(f, "begins with {first} and ends with {last}, but is periodic")
            }
            Self::LinearTable => {
                write!(f, "makes corners at the rows, where accelerations would have no bound")
            }
            Self::SumAtStart([found, needed]) => {
                write!(
                    f,
                    "is {found} with the values of its joints at the start, but must be {needed}"
                )
            }
            Self::NoSingleCoordinate(n) => {
                write!(f, "is a joint with {n} coordinates; exactly one is needed")
            }
            Self::GuideNotWhole { needed, found } => {
                write!(f, "is guided by {found} of the {needed} motions that its joint needs")
            }
            Self::GuideWelded => write!(f, "is between bodies that are welded together"),
            Self::NoSingleRotation(n) => {
                write!(f, "is a joint with {n} rotations; exactly one is needed")
            }
            Self::GivenTwice(i) => write!(f, "is already prescribed by number {}", i + 1),
            Self::Contradiction { given, guide } => {
                write!(f, "is {given}, but the guide of the joint starts with {guide}")
            }
            Self::TableSlope { is_end, time, rate, .. } => {
                let [verb, held] = if *is_end { ["ends", "after"] } else { ["begins", "before"] };
                write!(
                    f,
                    "{verb} at {time} s, within the run, with a rate of {rate:.3} rad/s (or m/s): \
                     its value is held {held} that, and the jump is an impact"
                )
            }
            Self::SignalCircle => write!(f, "needs itself"),
            Self::SignalNotSmooth { broken, .. } => {
                write!(f, "follows signal {}, which {broken}", broken.signal.index() + 1)
            }
            Self::SignalNoRate => {
                write!(f, "needs the rate of a measured rate, or of a controller: it is not known")
            }
            Self::TableOrder(row) => {
                write!(f, "has times that do not increase at row {}", row + 1)
            }
            Self::LimitOrder([upper, lower]) => {
                write!(f, "has its upper limit {upper} not above its lower limit {lower}")
            }
            Self::RangeOrder([lower, upper]) => {
                write!(f, "is {lower}, which is not below the upper end {upper}")
            }
            Self::EmptyRange([lower, upper]) => {
                write!(f, "has its lower end {lower} not below its upper end {upper}")
            }
            Self::NoRange => write!(f, "is that of the joint, which has none"),
            Self::NoMovedMass => write!(
                f,
                "is left out, but does not follow from the scene: the coordinate moves no mass of its own"
            ),
            Self::StaticBelowCoulomb([static_, coulomb]) => {
                write!(f, "is {static_}, which is less than the Coulomb friction {coulomb}")
            }
            Self::PieceCoefficients { piece, found } => {
                let plural = if *found == 1 { "" } else { "s" };
                write!(f, "has {found} coefficient{plural} in piece {}", piece + 1)
            }
            Self::PieceRange(i) => write!(f, "has no range in piece {}", i + 1),
            Self::PieceGap(i) => {
                write!(f, "has a gap or an overlap before piece {}", i + 1)
            }
            Self::CalspanRange => {
                write!(f, "needs A0, A2, omega, B3 and skid above zero, and A4 not zero")
            }
            Self::PointOrder(i) => write!(f, "has x that does not increase at point {}", i + 1),
            Self::LongRounding { rounding, most } => {
                write!(f, "is {rounding}, which is more than half the length, {most}")
            }
            Self::TightHollow { hollow, wheel } => write!(
                f,
                "makes a hollow of radius {hollow:.4} m, too tight for a wheel of radius {wheel} m"
            ),
            Self::Missing => write!(f, "is missing"),
            Self::SpinElsewhere => write!(f, "does not join the tire's body to a wheel"),
            Self::SpinAxis => write!(f, "turns about another axis than the tire's"),
            Self::FreeRotor => write!(f, "is a free joint, which holds no rotor"),
            Self::RotorRatio(x) => {
                write!(f, "makes an inertia of {x} at the joint: inertia times its square")
            }
            Self::Relation(fault) => write!(f, "{fault}"),
            Self::NotUsed => write!(f, "has no meaning here"),
        }
    }
}

impl Display for SceneFault {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.problem(f)?;
        if f.alternate() { Ok(()) } else { write!(f, "; {}", self.advice()) }
    }
}
