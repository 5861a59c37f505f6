//! Faults of a scene, and their texts.

use super::{BodyId, NotDrawn, NotStrands};
use crate::joint::{Dimension, JointKind};
use crate::laws::relation::RelationFault;
use crate::scene::SignalBreak;
use core::fmt::{self, Display, Formatter};

/// Fault of a scene.
///
/// The text of a fault continues a sentence that begins with a key. `{}` says what is wrong and what to do, `{:#}` only what is
/// wrong. [`SceneFault::advice`] gives only the remedy.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SceneFault {
    /// A number is infinite or NaN.
    NotFinite,
    /// A number is not positive. The field is the number.
    NotPositive(f64),
    /// A number is negative. The field is the number.
    Negative(f64),
    /// An axis has no direction.
    ZeroAxis,
    /// The two axes of a joint are parallel.
    ParallelAxes,
    /// Two points coincide: the ends of a rod, or the points of a distance joint or of a spring.
    CoincidentPoints,
    /// The two points of a joint differ, but this kind of joint has one place (scenes built in code).
    PointsDiffer,
    /// A name is used twice. The field is the index of the first use.
    DuplicateName(usize),
    /// A name is also the name of a body. The field is the index of the body.
    NameOfBody(usize),
    /// A name is empty, or is `ground` (a body) or `t` (an output).
    ReservedName,
    /// An index refers to no entry (scenes built in code).
    UnknownReference,
    /// The ground is named where a body is required.
    NeedsMovingBody,
    /// A user-defined law in code is given where data is required.
    InCode,
    /// Two bodies are required, but one body is named twice.
    SameBody,
    /// A joint or effect uses the rotation of a point mass, which has none. The field is the index of the body.
    PointTurns(usize),
    /// A place on a point mass differs from the place of its mass.
    OffPoint {
        /// Index of the body.
        body: usize,
        /// Distance of the two places [m].
        by: f64,
    },
    /// A principal moment of inertia is larger than the sum of the other two. The field has the moment, then the sum [kg m^2].
    /// Welded bodies are checked together.
    TriangleInequality([f64; 2]),
    /// The inertia has a negative principal moment, which is the field [kg m^2].
    NegativeInertia(f64),
    /// A body without mass has inertia.
    InertiaWithoutMass,
    /// A joint kind or key requires a spatial scene.
    NeedsSpatial,
    /// A shape requires a planar scene.
    NeedsPlanar,
    /// A number is not between 0 and 1. The field is the number.
    NotAShare(f64),
    /// A vector of a planar scene has a component out of the plane. The field is this component.
    OutOfPlane(f64),
    /// The form of the inertia does not fit the dimension of the scene.
    WrongDimension,
    /// A list has the wrong count of numbers.
    WrongCount {
        /// Count of numbers that is required.
        needed: usize,
        /// Count of numbers that is given.
        found: usize,
    },
    /// The joint has no coordinates.
    NoCoordinate,
    /// The effect does not measure a single number.
    NoMeasure,
    /// The effect acts on both sides, so that it has no contact.
    NoContact,
    /// The effect has no deflection, because it has neither a free value nor a gap.
    NoDeflection,
    /// An output of a tire names another kind of effect.
    NotATire,
    /// The quantity of an output has no vector, so that it has no magnitude and no axes.
    NoVector,
    /// The quantity of an output has no angle, so that its unit cannot be chosen.
    NoAngle,
    /// The joint does not have this coordinate. The field is the number of its coordinates.
    UnknownCoordinate(usize),
    /// The coordinate is a component of a rotation vector, which is not an independent angle.
    BallCoordinate,
    /// The angle belongs to a ball joint, but the joint has no ball.
    NoBall,
    /// A coupling contains an angle of a ball joint, which only effects and signals can use.
    BallHeld,
    /// A signal measures the twist of a ball joint, which has no value at a swing of half a turn.
    TwistMeasured,
    /// The joint has several coordinates, and none of their names or numbers is given.
    NeedsCoordinate {
        /// Kind of the joint.
        joint: JointKind,
        /// Dimension of the scene.
        dimension: Dimension,
        /// Number of the coordinate that is given.
        given: Option<usize>,
    },
    /// A coupling has no term with a factor other than zero.
    NoTerm,
    /// A disc is flat on the plane that it rolls on.
    LiesFlat,
    /// The direction of a blade is along the normal of the plane.
    AlongNormal,
    /// A wheel or ball does not touch its plane. The field is the height of its lowest point above the plane [m].
    Apart(f64),
    /// A periodic curve has different values at its ends. The field has both values.
    PeriodicEnds([f64; 2]),
    /// A table is linear between its rows where its accelerations are required.
    LinearTable,
    /// A pitch point is given for a coupling that is no pair of wheels with parallel axes in one body.
    NoMesh,
    /// A pretension is given for a coupling whose strands are unknown.
    NotStrands(NotStrands),
    /// A pitch point does not divide the distance of the axes in the ratio of the factors. The field is the right place [m].
    OffPitch([f64; 3]),
    /// A length is given for a coupling that has no lines.
    NoLine,
    /// A coupling is declared as drawn, but places and axes do not determine its sum.
    NotDrawn(NotDrawn),
    /// No body carries both parts of a drawn coupling.
    NoCarrier {
        /// Bodies that carry the first part and the second.
        bodies: [BodyId; 2],
        /// Joint about whose axis one of these bodies would have to turn on the other.
        about: usize,
    },
    /// A pressure angle is negative, or a quarter turn or more [rad].
    PressureAngle(f64),
    /// The start values of the joints give another sum than the coupling. The field has the sum that they give, then the required
    /// sum.
    SumAtStart([f64; 2]),
    /// A guide needs a joint with one coordinate. The field is the number of coordinates of the joint.
    NoSingleCoordinate(usize),
    /// A joint is guided in part only. Guides must cover all its coordinates, in their order.
    GuideNotWhole {
        /// Number of coordinates of the joint.
        needed: usize,
        /// Number of guided coordinates, in their order.
        found: usize,
    },
    /// A guide acts between bodies that are welded together.
    GuideWelded,
    /// An effect needs a joint with one rotation. The field is the number of rotations of the joint.
    NoSingleRotation(usize),
    /// A number is prescribed by two entries. The field is the index of the first entry.
    GivenTwice(usize),
    /// A value of an initial condition contradicts the guide of its joint.
    Contradiction {
        /// Value that the entry gives.
        given: f64,
        /// Value that the guide gives at t = 0.
        guide: f64,
    },
    /// The table of a guide begins or ends within the run with a rate that is not zero, which is an impact.
    TableSlope {
        /// Index of the row.
        row: usize,
        /// True if the row is the end of the table. Otherwise it is the beginning.
        is_end: bool,
        /// Time of the row [s].
        time: f64,
        /// Rate at the row [rad/s or m/s].
        rate: f64,
    },
    /// A signal is an operand of itself, directly or through other signals.
    SignalCircle,
    /// The signal is not smooth, but a guide or a coupling requires it.
    SignalNotSmooth {
        /// Break at which the signal is not smooth.
        broken: SignalBreak,
        /// Remedy that makes the signal smooth.
        remedy: &'static str,
    },
    /// A controller requires the rate of a signal whose rate is not known.
    SignalNoRate,
    /// Times in a table do not increase. The field is the index of the first row that is not later than the row before.
    TableOrder(usize),
    /// The upper limit is not above the lower one. The field has both limits.
    LimitOrder([f64; 2]),
    /// The lower end of a range is not below its upper end. The field has both ends.
    RangeOrder([f64; 2]),
    /// A range is empty. The field has its ends, the lower end first.
    EmptyRange([f64; 2]),
    /// A limit takes its range from the joint, which has none.
    NoRange,
    /// A stiffness is to follow from the mass that a coordinate moves, but the coordinate moves no mass or is guided.
    NoMovedMass,
    /// Static friction is less than Coulomb friction. The field has both forces.
    StaticBelowCoulomb([f64; 2]),
    /// A polynomial has a piece without coefficients, or with too many.
    PieceCoefficients {
        /// Index of the piece.
        piece: usize,
        /// Number of its coefficients.
        found: usize,
    },
    /// A piece of a polynomial does not end above its beginning. The field is the index of the piece.
    PieceRange(usize),
    /// A piece of a polynomial does not begin at the end of the piece before. The field is the index of the piece.
    PieceGap(usize),
    /// The joint of a spinning wheel does not connect the tire's body to a wheel.
    SpinElsewhere,
    /// The joint of a spinning wheel turns about another axis than the wheel.
    SpinAxis,
    /// A rotor is on a free joint, which has no axis.
    FreeRotor,
    /// The inertia of a rotor at its joint is zero or not a number. The field is the inertia [kg m^2 or kg].
    RotorRatio(f64),
    /// Coefficients of a tire make its formulas divide by zero.
    CalspanRange,
    /// Points of a road do not increase in x. The field is the index of the first point that is not beyond the point before.
    PointOrder(usize),
    /// The rounded corners of a rise overlap; lengths in [m].
    LongRounding {
        /// Length of a corner.
        rounding: f64,
        /// Half the length of the rise, the largest allowed rounding.
        most: f64,
    },
    /// A hollow of the road is so tight that a wheel would touch it twice; radii in [m].
    TightHollow {
        /// Smallest radius of the hollow.
        hollow: f64,
        /// Radius of the largest wheel.
        wheel: f64,
    },
    /// A key that this kind needs is missing.
    Missing,
    /// A user-defined relation of a coupling has a fault.
    Relation(RelationFault),
    /// A key is given that this kind does not use.
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
