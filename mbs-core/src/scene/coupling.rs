//! Couplings: relations of joint coordinates and lengths that hold, such as gears, racks, screws, belts, cams and ropes.
//!
//! ```text
//! sum_k c_k m_k(q) = value + f(t)          m_k: a joint coordinate, unwrapped, or a length; or a curve of one
//! ```
//!
//! Every kind of coupling is such a sum; the constructors below write them. Coordinates and lengths count from the reference
//! configuration.

use crate::Real;
use crate::scene::{BodyId, Curve, JointId, Motion, Number};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

/// A relation of joint coordinates and lengths that holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling<T> {
    /// Unique name among the couplings.
    pub name: String,
    /// The terms of the sum, at least one.
    pub terms: Vec<CouplingTerm<T>>,
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
}

impl<T> CouplingMeasure<T> {
    /// The joint and the number of a coordinate; `None` of a length.
    #[must_use]
    pub const fn coordinate(&self) -> Option<(JointId, usize)> {
        match self {
            Self::Coordinate { joint, number } => Some((*joint, *number)),
            Self::Length { .. } => None,
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
        Self { name: String::new(), terms, value: Number::ZERO, motion: None }
    }

    /// Two wheels in external mesh about parallel axes: `teeth[0]` of the first turn against `teeth[1]` of the second.
    #[must_use]
    pub fn gear(joints: [JointId; 2], teeth: [u32; 2]) -> Self {
        let [first, second] = teeth.map(f64::from);
        Self::linear([(joints[0], first), (joints[1], second)])
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
