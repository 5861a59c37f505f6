//! A link: one body, or a massless one between the parts of a composed joint, with the joint to its parent.

use crate::link::indexing::{Outside, at};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// The joints of the recursion. All others are made of several of these.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkKind {
    /// Turns about an axis fixed in the parent; one freedom.
    Revolute,
    /// Slides along an axis fixed in the parent; one freedom.
    Prismatic,
    /// A ball joint; three freedoms (space only).
    Ball,
    /// Free against the ground; six freedoms, in the plane three.
    Free,
    /// A revolute joint whose angle is prescribed.
    GuidedRevolute,
    /// A prismatic joint whose slide is prescribed.
    GuidedPrismatic,
    /// A ball whose rotation vector is prescribed (space only).
    GuidedBall,
}

impl LinkKind {
    /// Number of freedoms of the joint.
    #[must_use]
    pub fn n_freedoms<T: Real, S: Space<T>>(self) -> usize {
        match self {
            Self::Revolute | Self::Prismatic => 1,
            Self::Ball => S::Spin::N,
            Self::Free => S::Motion::N,
            Self::GuidedRevolute | Self::GuidedPrismatic | Self::GuidedBall => 0,
        }
    }

    /// Number of coordinates that hold the position.
    #[must_use]
    pub fn n_coordinates<T: Real, S: Space<T>>(self) -> usize {
        match self {
            Self::Ball => S::FREE - S::Point::N,
            Self::Free => S::FREE,
            _ => self.n_freedoms::<T, S>(),
        }
    }

    /// Is its motion prescribed?
    #[must_use]
    pub fn is_guided(self) -> bool {
        matches!(self, Self::GuidedRevolute | Self::GuidedPrismatic | Self::GuidedBall)
    }
}

/// A link of the tree. Link 0 is the ground; a parent stands before its children.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link<T: Real, S: Space<T>> {
    /// The link it hangs from.
    pub parent: u32,
    /// Kind of the joint to the parent.
    pub kind: LinkKind,
    /// First of its coordinates in z.
    pub z: u32,
    /// First of its freedoms in v; of a guided joint the number of its guide, of a guided ball the first of three.
    pub v: u32,
    /// Unit axis of a revolute joint, reference axes; of a guided ball ±x, where its rotation vector is that of the link against its
    /// parent or of the parent against it.
    pub axis: S::Spin,
    /// Unit direction of a prismatic joint, reference axes.
    pub direction: S::Point,
    /// From the parent's origin to the joint, reference axes [m].
    pub offset: S::Point,
    /// Mass of the link [kg].
    pub mass: T,
    /// From the link's origin to its centre of mass, reference axes [m].
    pub center: S::Point,
    /// Inertia about the link's origin, reference axes [kg m^2].
    pub tensor: S::Tensor,
}

impl<T: Real, S: Space<T>> Link<T, S> {
    /// The angle against its parent in the plane, at a coordinate; of a free link against the ground [rad].
    pub(crate) fn turn(&self, coordinate: T) -> T {
        match self.kind {
            // the plane has no guided balls
            LinkKind::Prismatic | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => T::ZERO,
            LinkKind::Revolute | LinkKind::GuidedRevolute => self.axis[0] * coordinate,
            LinkKind::Ball | LinkKind::Free => coordinate,
        }
    }

    /// Angle or slide of a joint with one coordinate, its rate and what is known of its acceleration, by coordinates, velocities and guides.
    #[inline(always)]
    pub(crate) fn coordinate(
        &self,
        (z, v, guides): (&[T], &[T], &[[T; 3]]),
    ) -> Result<[T; 3], Outside> {
        if self.kind.is_guided() {
            return at(guides, self.v as usize).copied();
        }
        Ok([*at(z, self.z as usize)?, *at(v, self.v as usize)?, T::ZERO])
    }
}

/// Place and motion of a link, world axes, about its own origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkMotion<T: Real, S: Space<T>> {
    /// Rotation from the reference configuration.
    pub rotation: S::Rotation,
    /// Origin of the link, from the tree's base [m].
    pub position: S::Point,
    /// From the parent's origin to its own [m].
    pub arm: S::Point,
    /// Motion b of unit rate of a joint with one freedom; of a guided ball the motion that its guides give.
    pub freedom: S::Motion,
    /// Velocity (ω, v) of the link.
    pub velocity: S::Motion,
    /// Acceleration d of the link without joint accelerations and its parent's acceleration.
    pub bias: S::Motion,
    /// From its origin to its centre of mass [m].
    pub center: S::Point,
}

impl<T: Real, S: Space<T>> LinkMotion<T, S> {
    /// Returns the place of the ground, at rest.
    #[must_use]
    pub fn ground() -> Self {
        Self {
            rotation: S::identity(),
            position: S::Point::zero(),
            arm: S::Point::zero(),
            freedom: S::Motion::zero(),
            velocity: S::Motion::zero(),
            bias: S::Motion::zero(),
            center: S::Point::zero(),
        }
    }
}

/// Inertia and forces of a link's subtree after condensation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArticulatedInertia<T: Real, S: Space<T>> {
    /// Articulated inertia of the subtree; after its joint's elimination its factors, where the joint has several freedoms.
    pub inertia: S::Inertia,
    /// Bias force p: minus the condensed force.
    pub force: S::Motion,
    /// U = I b.
    pub column: S::Motion,
    /// 1 / bᵀ I b.
    pub inverse: T,
    /// Force u along the joint, all its freedoms in world axes.
    pub drive: S::Motion,
    /// Torque or force of effects along a joint of one freedom.
    pub effort: T,
    /// Inertia that rotors and effects add to bᵀ I b of a joint of one freedom. Effects add by their resistance to its acceleration within
    /// a step.
    pub resistance: T,
}

impl<T: Real, S: Space<T>> ArticulatedInertia<T, S> {
    /// Returns no inertia and no force.
    #[must_use]
    pub fn empty() -> Self {
        Self {
            inertia: S::no_inertia(),
            force: S::Motion::zero(),
            column: S::Motion::zero(),
            inverse: T::ZERO,
            drive: S::Motion::zero(),
            effort: T::ZERO,
            resistance: T::ZERO,
        }
    }
}

/// Inertia that a rotor adds to the coordinate of a link with one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkRotor<T> {
    /// Number of the link.
    pub link: u32,
    /// Inertia times the square of the ratio [kg m^2, of a slide kg].
    pub inertia: T,
}
