//! Couplings: relations of joint coordinates and lengths that hold, such as gears, racks, screws, belts, cams and ropes.
//!
//! ```text
//! sum_k c_k m_k(q) = value + f(t)          m_k: a joint coordinate, unwrapped, or a length; or a curve of one
//! ```
//!
//! Every kind of coupling is such a sum; the constructors below write them. A [relation](Coupling::relation) in code holds any
//! other function of the measures. Coordinates and lengths count from the reference configuration.

use crate::Real;
use crate::laws::code::Code;
use crate::laws::relation::Relation;
use crate::scene::{BodyId, Curve, JointId, Motion, Number, Vector3};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

/// 2 pi to more digits than any precision has.
const TWO_PI: &str = "6.28318530717958647692528676655900576839433879875021";

/// A relation of joint coordinates and lengths that holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling<T> {
    /// Unique name among the couplings.
    pub name: String,
    /// The terms of the sum, at least one.
    pub terms: Vec<CouplingTerm<T>>,
    /// A user-defined function of the terms that is held in place of their sum; in code only.
    pub relation: Option<Code<dyn Relation>>,
    /// What the sum is, from the reference configuration [unit of a factor times its coordinate].
    pub value: T,
    /// What is added to the value in the course of time.
    pub motion: Option<Motion<T>>,
}

/// A term of a coupling: `factor` times a measured number, or a curve of it.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingTerm<T> {
    /// Its factor.
    pub factor: T,
    /// The number.
    pub of: CouplingMeasure<T>,
    /// The function of the number that is meant; `None`: the number itself.
    pub curve: Option<Curve<T>>,
}

/// A number that a mechanism has: zero in the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub enum CouplingMeasure<T> {
    /// A coordinate of a joint [rad or m]; angles count their turns.
    Coordinate {
        /// The joint.
        joint: JointId,
        /// The place of the coordinate among the joint's, from 0.
        number: usize,
    },
    /// The length of a line over points of bodies, less that in the reference configuration [m].
    Length {
        /// The points, reference configuration [m].
        points: Vec<(BodyId, [T; 3])>,
    },
    /// An angle of a ball, zero in the reference configuration [rad]; of effects only.
    Ball {
        /// The joint.
        joint: JointId,
        /// Which angle.
        angle: BallAngle,
        /// A direction that is fixed in the first body; and in the second, which has the same in the reference configuration.
        axis: [T; 3],
    },
}

/// An angle of a ball joint, by an axis `a` in the first body and `b` in the second that were one in the reference configuration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BallAngle {
    /// The angle between them, from 0 to pi.
    Swing,
    /// The turn about the axis that is left when the smallest turn that carries `a` to `b` is taken off.
    Twist,
}

impl BallAngle {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Swing, Self::Twist];

    /// Its name in scene files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Swing => "swing",
            Self::Twist => "twist",
        }
    }
}

impl From<JointId> for CouplingMeasure<Number> {
    fn from(joint: JointId) -> Self {
        Self::Coordinate { joint, number: 0 }
    }
}

impl From<(JointId, usize)> for CouplingMeasure<Number> {
    fn from((joint, number): (JointId, usize)) -> Self {
        Self::Coordinate { joint, number }
    }
}

impl CouplingMeasure<Number> {
    /// The length of a line over points of bodies [m].
    #[must_use]
    pub fn line<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        Self::Length { points: points.into_iter().map(|(body, at)| (body, at.into().0)).collect() }
    }
}

impl<T> CouplingMeasure<T> {
    /// The joint and the number of a coordinate; `None` of a length, and of an angle of a ball.
    #[must_use]
    pub const fn coordinate(&self) -> Option<(JointId, usize)> {
        match self {
            Self::Coordinate { joint, number } => Some((*joint, *number)),
            Self::Length { .. } | Self::Ball { .. } => None,
        }
    }
}

impl<T> Coupling<T> {
    /// Does its sum change with time?
    #[must_use]
    pub const fn is_driven(&self) -> bool {
        self.motion.is_some()
    }

    /// Is its sum not always zero? It then has a place behind the [guides](crate::inputs::Prescribed::guides).
    #[must_use]
    pub fn has_sum(&self) -> bool
    where
        T: Real,
    {
        self.is_driven() || !self.value.is_zero()
    }
}

impl CouplingTerm<Number> {
    /// A factor times an angle of a ball joint, by an axis of the reference configuration.
    pub fn of_ball(
        joint: JointId,
        angle: BallAngle,
        axis: impl Into<Vector3>,
        factor: impl Into<Number>,
    ) -> Self {
        let of = CouplingMeasure::Ball { joint, angle, axis: axis.into().0 };
        Self { factor: factor.into(), of, curve: None }
    }

    /// A factor times the coordinate `number` of a joint.
    pub fn of_joint(joint: JointId, number: usize, factor: impl Into<Number>) -> Self {
        let of = CouplingMeasure::Coordinate { joint, number };
        Self { factor: factor.into(), of, curve: None }
    }
}

impl Coupling<Number> {
    /// The sum of `factor` times a joint's first coordinate is zero.
    #[must_use]
    pub fn linear(terms: impl IntoIterator<Item = (JointId, f64)>) -> Self {
        let term = |(joint, factor)| CouplingTerm::of_joint(joint, 0, factor);
        Self::of(terms.into_iter().map(term).collect())
    }

    /// Any terms, whose sum is zero.
    #[must_use]
    pub const fn of(terms: Vec<CouplingTerm<Number>>) -> Self {
        Self { name: String::new(), terms, relation: None, value: Number::ZERO, motion: None }
    }

    /// A user-defined relation of measures, whose value is zero: a joint stands for its first coordinate.
    ///
    /// Measures count from the reference configuration. Another value is [held](Self::holding) or [follows time](Self::driven). It is
    /// code, which no file has.
    #[must_use]
    pub fn relation<M: Into<CouplingMeasure<Number>>>(
        measures: impl IntoIterator<Item = M>,
        relation: impl Relation + 'static,
    ) -> Self {
        let term = |of: M| CouplingTerm { factor: 1.into(), of: of.into(), curve: None };
        let relation = Some(relation.into());
        Self { relation, ..Self::of(measures.into_iter().map(term).collect()) }
    }

    /// Two wheels in external mesh about parallel axes: `teeth[0]` of the first turn against `teeth[1]` of the second.
    #[must_use]
    pub fn gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], second)])
    }

    /// A wheel inside a ring of teeth, about axes of the same sense: both turn alike, `teeth[0]` of the first for `teeth[1]` of the second.
    #[must_use]
    pub fn internal_gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], -second)])
    }

    /// A belt over two wheels of these radii [m] about axes of the same sense, which turn alike.
    #[must_use]
    pub fn belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], -radii[1])])
    }

    /// A crossed belt: its wheels turn against each other.
    #[must_use]
    pub fn crossed_belt(joints: [JointId; 2], radii: [f64; 2]) -> Self {
        Self::linear([(joints[0], radii[0]), (joints[1], radii[1])])
    }

    /// A screw in a cylindrical joint: it slides by `lead` [m] in a turn.
    #[must_use]
    pub fn screw(joint: JointId, lead: f64) -> Self {
        Self::screw_of((joint, 1), (joint, 0), lead)
    }

    /// A screw that turns in its first joint and moves the slide of the second by `lead` [m] in a turn.
    #[must_use]
    pub fn screw_between([turn, slide]: [JointId; 2], lead: f64) -> Self {
        Self::screw_of((turn, 0), (slide, 0), lead)
    }

    /// 2 pi s - lead a = 0, of joint coordinates by number.
    fn screw_of(turn: (JointId, usize), slide: (JointId, usize), lead: f64) -> Self {
        let per_turn = Number::from_decimal(TWO_PI).unwrap_or(Number::ZERO);
        Self::of(vec![
            CouplingTerm::of_joint(slide.0, slide.1, per_turn),
            CouplingTerm::of_joint(turn.0, turn.1, -lead),
        ])
    }

    /// The first joint's coordinate is `factor` times the second's.
    #[must_use]
    pub fn mimic([joint, of]: [JointId; 2], factor: f64) -> Self {
        Self::linear([(joint, 1.0), (of, -factor)])
    }

    /// Two wheels with these teeth, and the carrier of what runs between them: Na (a - c) + Nb (b - c) = 0.
    #[must_use]
    pub fn differential([a, b, cage]: [JointId; 3], teeth: [u32; 2]) -> Self {
        let [of_a, of_b] = teeth.map(f64::from);
        Self::linear([(a, of_a), (b, of_b), (cage, -(of_a + of_b))])
    }

    /// A line of constant length over points of bodies [m], without friction: it pulls and pushes.
    #[must_use]
    pub fn rope<P: Into<Vector3>>(points: impl IntoIterator<Item = (BodyId, P)>) -> Self {
        let of = CouplingMeasure::line(points);
        Self::of(vec![CouplingTerm { factor: 1.into(), of, curve: None }])
    }

    /// The same rope, of which a drum of this radius [m] takes in as much as its joint turns.
    #[must_use]
    pub fn with_drum(mut self, joint: JointId, radius: f64) -> Self {
        self.terms.push(CouplingTerm::of_joint(joint, 0, radius));
        self
    }

    /// A rack: the slide of the second joint is `radius` [m] times the angle of the first.
    #[must_use]
    pub fn rack([pinion, rack]: [JointId; 2], radius: f64) -> Self {
        Self::linear([(rack, 1.0), (pinion, -radius)])
    }

    /// The second joint's coordinate is a curve of the first's.
    #[must_use]
    pub fn cam([shaft, follower]: [JointId; 2], curve: Curve<Number>) -> Self {
        let of_shaft =
            CouplingTerm { curve: Some(curve), ..CouplingTerm::of_joint(shaft, 0, -1.0) };
        Self::of(vec![CouplingTerm::of_joint(follower, 0, 1.0), of_shaft])
    }

    /// The same coupling whose sum is `value`, from the reference configuration.
    #[must_use]
    pub fn holding(mut self, value: impl Into<Number>) -> Self {
        self.value = value.into();
        self
    }

    /// The same coupling whose sum follows a function of time.
    #[must_use]
    pub fn driven(mut self, motion: impl Into<Motion<Number>>) -> Self {
        self.motion = Some(motion.into());
        self
    }
}
