//! Links of the tree. A link is one body with the joint to its parent. The parts of a composed joint are connected by links without mass.

use crate::link::indexing::{Outside, at};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Kinds of joints in the recursion. Every other joint is composed of several joints of these kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkKind {
    /// Rotation about an axis fixed in the parent; one freedom.
    Revolute,
    /// Translation along an axis fixed in the parent; one freedom.
    Prismatic,
    /// A ball joint; three freedoms (space only).
    Ball,
    /// Free motion relative to the ground; six freedoms, in the plane three.
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

    /// Number of coordinates that store the position of the joint.
    #[must_use]
    pub fn n_coordinates<T: Real, S: Space<T>>(self) -> usize {
        match self {
            Self::Ball => S::FREE - S::Point::N,
            Self::Free => S::FREE,
            _ => self.n_freedoms::<T, S>(),
        }
    }

    /// True if a guide prescribes the motion of the joint.
    #[must_use]
    pub fn is_guided(self) -> bool {
        matches!(self, Self::GuidedRevolute | Self::GuidedPrismatic | Self::GuidedBall)
    }
}

/// A link of the tree. Link 0 is the ground. In the list of links, parents come before their children.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link<T: Real, S: Space<T>> {
    /// Index of the parent link.
    pub parent: u32,
    /// Kind of the joint to the parent.
    pub kind: LinkKind,
    /// Index of the link's first coordinate in z.
    pub z: u32,
    /// Index of the link's first freedom in v. For a guided joint: index of its guide. For a guided ball: index of the first of its three
    /// guides.
    pub v: u32,
    /// Unit axis of a revolute joint, in the axes of the reference configuration. For a guided ball the axis is ±x: +x if the guides
    /// prescribe the rotation of the link relative to its parent, −x if they prescribe the rotation of the parent relative to the link.
    pub axis: S::Spin,
    /// Unit direction of a prismatic joint, in the axes of the reference configuration.
    pub direction: S::Point,
    /// Vector from the parent's origin to the joint, reference axes [m].
    pub offset: S::Point,
    /// Mass of the link [kg].
    pub mass: T,
    /// Vector from the link's origin to its centre of mass, reference axes [m].
    pub center: S::Point,
    /// Inertia about the link's origin, reference axes [kg m^2].
    pub tensor: S::Tensor,
}

impl<T: Real, S: Space<T>> Link<T, S> {
    /// Angle of the link in the plane for a value of its coordinate [rad]. The angle is relative to the parent, for a free link relative to
    /// the ground.
    pub(crate) fn turn(&self, coordinate: T) -> T {
        match self.kind {
            // guided balls exist in space only
            LinkKind::Prismatic | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => T::ZERO,
            LinkKind::Revolute | LinkKind::GuidedRevolute => self.axis[0] * coordinate,
            LinkKind::Ball | LinkKind::Free => coordinate,
        }
    }

    /// Angle or slide of a joint with one coordinate, its rate, and the known part of its acceleration, from coordinates, velocities and
    /// guides.
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

/// Place and motion of a link about the link's origin, in world axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkMotion<T: Real, S: Space<T>> {
    /// Rotation from the reference configuration.
    pub rotation: S::Rotation,
    /// Origin of the link, from the tree's base [m].
    pub position: S::Point,
    /// Vector from the parent's origin to the link's origin [m].
    pub arm: S::Point,
    /// Motion b for unit rate of a joint with one freedom. For a guided ball: the motion that its guides prescribe.
    pub freedom: S::Motion,
    /// Velocity (ω, v) of the link.
    pub velocity: S::Motion,
    /// Acceleration d: the part of the link's acceleration that remains if the accelerations of its joint and of its parent are zero.
    pub bias: S::Motion,
    /// Vector from the link's origin to its centre of mass [m].
    pub center: S::Point,
}

impl<T: Real, S: Space<T>> LinkMotion<T, S> {
    /// Returns place and motion of the ground, which is at rest.
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

/// Articulated inertia and bias force of a link's subtree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArticulatedInertia<T: Real, S: Space<T>> {
    /// Articulated inertia of the subtree. The elimination of a joint with several freedoms replaces it by its factors.
    pub inertia: S::Inertia,
    /// Bias force p: minus the condensed force.
    pub force: S::Motion,
    /// Column U = I b.
    pub column: S::Motion,
    /// Inverse pivot 1 / bᵀ I b.
    pub inverse: T,
    /// Force u along the joint's freedoms, in world axes.
    pub drive: S::Motion,
    /// Torque or force that effects apply along a joint with one freedom.
    pub effort: T,
    /// Inertia that rotors and effects add to the pivot bᵀ I b of a joint with one freedom. An effect adds its stiffness and damping,
    /// multiplied by the integrator's coefficients, because its force changes with the acceleration within a step.
    pub resistance: T,
}

impl<T: Real, S: Space<T>> ArticulatedInertia<T, S> {
    /// Returns a value with zero inertia and zero force.
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

/// Inertia that a rotor adds to the coordinate of a link whose joint has one freedom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkRotor<T> {
    /// Index of the link.
    pub link: u32,
    /// Rotor inertia times the square of its transmission ratio [kg m^2; kg for a slide].
    pub inertia: T,
}
