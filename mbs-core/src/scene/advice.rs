//! Advice on the faults of a scene.

use crate::scene::{NotDrawn, NotStrands, SceneFault};

/// Advice on the joints and effects that a point mass can have.
const POINT_TURNS: &str = "a point takes the joints `spherical` (plane: `revolute`), `distance` and `free` as their second body, forces, and \
                           lengths; give what turns `center` and `inertia`";

impl SceneFault {
    /// Advice on the fault, in the imperative.
    #[must_use]
    #[allow(clippy::too_many_lines, reason = "one sentence for each fault")]
    pub fn advice(&self) -> &'static str {
        match self {
            Self::NotFinite => "write a finite number",
            Self::NotPositive(_) => "write a number larger than zero",
            Self::Negative(_) => "write zero or more",
            Self::ZeroAxis => "write a vector that is not zero; its length does not matter",
            Self::ParallelAxes => "turn one of the two axes; a right angle is usual",
            Self::CoincidentPoints => "move one of the two points",
            Self::PointsDiffer => "give the same place twice; only distance joints have two",
            Self::DuplicateName(_) | Self::NameOfBody(_) => "give each its own name",
            Self::ReservedName => {
                "choose another name: `ground` is the fixed frame, `t` the time column"
            }
            Self::UnknownReference => "use the index of something that is in the scene",
            Self::NeedsMovingBody => "name a body of the scene",
            Self::InCode => {
                "use a kind of effect that is data, or build the scene in the precision of the law"
            }
            Self::SameBody => "name two different bodies",
            Self::PointTurns(_) => POINT_TURNS,
            Self::OffPoint { .. } => "write the place of the body's `point`: it has no other",
            Self::TriangleInequality(_) => {
                "check the moments and products; flat bodies need all the digits they are given in"
            }
            Self::NegativeInertia(_) => "check the signs and the size of the products",
            Self::InertiaWithoutMass => {
                "give the body mass, set its inertia to zero, or weld it to a body with mass"
            }
            Self::NeedsSpatial => "set `dimension = 3` in [scene], or keep to what is planar",
            Self::NeedsPlanar => "set `dimension = 2` in [scene], or write a form of space",
            Self::NotAShare(_) => "write a number from 0 to 1",
            Self::OutOfPlane(_) => "keep planar scenes in the x-y plane",
            Self::WrongDimension => "planar bodies have one number, spatial bodies six",
            Self::WrongCount { .. } => "write as many numbers as the joint or table needs",
            Self::NoCoordinate => "remove this entry, or name another joint",
            Self::NoMeasure => {
                "ask for `force`, `energy` or `power`, or name an effect along a line or on a joint"
            }
            Self::NoContact => "name a bumper, a limit or a tire",
            Self::NotATire => "name a tire, or leave the output out",
            Self::NoVector => "leave the key out, or choose a quantity with components x and y",
            Self::NoAngle => "leave the key out, or choose an angle, its rate or its acceleration",
            Self::NoDeflection => "name a spring, a bumper, a limit or a tire",
            Self::UnknownCoordinate(_) => "count the joint's coordinates from 0",
            Self::NeedsCoordinate { .. } => "write one of these names",
            Self::BallCoordinate => "name a joint that turns about axes, such as a universal joint",
            Self::NoBall => "name a joint with a ball, such as a spherical one",
            Self::TwistMeasured => "measure the swing, or a joint that turns about axes",
            Self::BallHeld => {
                "use it in the `terms` of an effect, or hold a joint that turns about axes"
            }
            Self::NoTerm => "write a term with a factor that is not zero",
            Self::LiesFlat => "turn the axis away from the normal",
            Self::AlongNormal => "give the direction along which it may move",
            Self::Apart(_) => "move `center` or the plane's `point`, or leave `plane` out",
            Self::NoMesh => "leave it out, or name two joints with parallel axes",
            Self::NotStrands(NotStrands::Wheels) => {
                "leave it out: the motion is right without it, and reactions are marked"
            }
            Self::NotStrands(NotStrands::Planes(_)) => {
                "move `at` of both joints into the plane of the belt"
            }
            Self::NotStrands(NotStrands::Inside(_)) => {
                "write the radii in metres; both together are smaller than the distance of the axes"
            }
            Self::OffPitch(_) => "write this place, or move it along the axes",
            Self::NoLine => "write `value` for the sum of a coupling",
            Self::NotDrawn(NotDrawn::Parallel) => {
                "write the sum as `linear`, with the sign of each factor, or a `ratio` of a gear"
            }
            Self::NotDrawn(NotDrawn::PitchLine) => {
                "move `at` of the rack's joint to its pitch line, or write the sum as `linear`"
            }
            Self::NoCarrier { .. } => "add that joint, or write the sum as `linear`",
            Self::PressureAngle(_) => "write it in radians: 20 degrees are 0.349",
            Self::PeriodicEnds(_) => "end the table with the value that it begins with",
            Self::LinearTable => "write \"monotone\": it is smooth, and stays between its rows",
            Self::SumAtStart(_) => {
                "change one of the initial values, or leave it out: the others determine it"
            }
            Self::NoSingleCoordinate(_) => "use a revolute or prismatic joint",
            Self::GuideNotWhole { .. } => {
                "give `signals`, one name for each coordinate: translations first, then turns or the rotation vector"
            }
            Self::GuideWelded => "guide a joint whose bodies move, or remove the weld",
            Self::NoSingleRotation(_) => "use a revolute or cylindrical joint",
            Self::GivenTwice(_) => "remove one of the two",
            Self::Contradiction { .. } => {
                "remove the initial entry: the guide gives the initial value and rate"
            }
            Self::TableSlope { .. } => {
                "add `ends = \"level\"` beside `table`: it then begins and ends at rest"
            }
            Self::SignalCircle => "take one of its operands out",
            Self::SignalNotSmooth { remedy, .. } => remedy,
            Self::SignalNoRate => "leave `d` out, or measure the value: its rate is known",
            Self::TableOrder(_) => "sort the rows by time and keep one row per time",
            Self::LimitOrder(_) => "write the upper limit first: [U, L] with U > L",
            Self::RangeOrder(_) => "write the lower end below the upper end",
            Self::EmptyRange(_) => "write the lower end first: [lower, upper] with lower < upper",
            Self::NoRange => {
                "add `range = [lower, upper]` to the joint, or write `lower` and `upper`"
            }
            Self::NoMovedMass => "write `stiffness` and `damping`",
            Self::StaticBelowCoulomb(_) => "leave `static` out, or make it at least `coulomb`",
            Self::PieceCoefficients { .. } => {
                "write one to eight coefficients after the two ends: [lower, upper, c0, c1, ...]"
            }
            Self::PieceRange(_) => "write each piece as [lower, upper, c0, ...], lower first",
            Self::PieceGap(_) => "sort the pieces; begin each where the one before ends",
            Self::CalspanRange => "check the order: a = [A0, A1, A2, A3, A4], b = [B1, B3, B4]",
            Self::PointOrder(_) => "sort the points by x and keep one point per x",
            Self::LongRounding { .. } => "make it at most half the length",
            Self::TightHollow { .. } => "round the hollow: more length or rounding, or less height",
            Self::Missing => "add it",
            Self::SpinElsewhere => "name the joint by which the wheel turns on `body`",
            Self::SpinAxis => "leave `axis` out: the wheel then has that of the joint",
            Self::FreeRotor => "name a joint that has an axis",
            Self::RotorRatio(_) => {
                "write how far the rotor turns for each unit of the joint's coordinate"
            }
            Self::Relation(fault) => fault.advice(),
            Self::NotUsed => "remove it",
        }
    }
}
