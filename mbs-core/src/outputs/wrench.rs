//! The wrenches a joint can transmit, as directions in global axes at the joint's place on the second body.
//!
//! | joint | forces | moments (a: axis, v, w: across it, in the first body) |
//! |---|---|---|
//! | revolute | all | v, w; plane: none |
//! | spherical | all | none |
//! | universal | all | a x b |
//! | prismatic | v, w | all |
//! | cylindrical | v, w | v, w |
//! | planar | a | v, w |
//! | weld | all | all |
//! | distance | along the link; hinged: a | none |
//! | free | none | none |
//!
//! A guide adds the direction it drives: the moment about a, or the force along it.

use super::frame::normalised;
use crate::Real;
use crate::algebra::{Matrix, Vector, cross, raised, unit};
use crate::natural::{Affine, NaturalModel, joint_axes, transverse};
use crate::scene::{BodyId, Dimension, Joint, JointKind, Scene};

/// A force and a moment about the joint's place [N, N m], or about a body's centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench<T: Real> {
    /// Force [N].
    pub force: Vector<T, 3>,
    /// Moment [N m].
    pub moment: Vector<T, 3>,
}

impl<T: Real> Wrench<T> {
    pub(super) fn zero() -> Self {
        Self { force: Vector::zeros(), moment: Vector::zeros() }
    }

    /// Multiplied by a number.
    pub(super) fn scaled(&self, s: T) -> Self {
        Self { force: self.force * s, moment: self.moment * s }
    }

    /// This and another about the same place.
    pub(super) fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.moment += other.moment;
    }

    /// The same wrench about another place; `arm` leads from there to its own.
    pub(super) fn shifted(&self, arm: &Vector<T, 3>) -> Self {
        Self { force: self.force, moment: self.moment + cross(arm, &self.force) }
    }
}

/// What a joint can transmit, by its kind and axes alone.
#[derive(Debug, Clone, PartialEq)]
pub struct JointWrenches<T: Real> {
    dimension: Dimension,
    kind: JointKind,
    /// a, v, w in the reference configuration.
    axes: [Vector<T, 3>; 3],
    second_axis: Vector<T, 3>,
    is_hinged: bool,
    is_guided: bool,
    length: T,
}

impl<T: Real> JointWrenches<T> {
    /// Of a joint that passed its scene's check. Moments are unit forces at a lever of `length` [m], so that all directions
    /// are forces.
    #[must_use]
    pub fn new(joint: &Joint<T>, dimension: Dimension, is_guided: bool, length: T) -> Self {
        let [a, b] = joint_axes(joint, dimension).map(Vector::<T, 3>::from);
        let [v, w] = transverse(&a, dimension);
        Self {
            dimension,
            kind: joint.kind,
            axes: [a, v, w],
            second_axis: b,
            is_hinged: joint.kind == JointKind::Distance && joint.axes[0].is_some(),
            is_guided,
            length,
        }
    }

    /// How many directions it has.
    #[must_use]
    pub fn n_directions(&self) -> usize {
        let spatial = self.dimension == Dimension::Spatial;
        let n = match self.kind {
            JointKind::Free => 0,
            JointKind::Distance => 1 + usize::from(self.is_hinged),
            JointKind::Revolute if spatial => 5,
            JointKind::Prismatic if spatial => 5,
            JointKind::Weld if spatial => 6,
            JointKind::Weld | JointKind::Spherical | JointKind::Planar => 3,
            JointKind::Revolute | JointKind::Prismatic => 2,
            JointKind::Universal | JointKind::Cylindrical => 4,
        };
        n + usize::from(self.is_guided)
    }

    /// Hands out its directions; `places` are those of the joint on both bodies [m], whose rotations are `turned`.
    pub fn directions(
        &self,
        places: impl Fn(usize) -> Vector<T, 3>,
        turned: [&Matrix<T, 3>; 2],
        mut take: impl FnMut(Wrench<T>),
    ) {
        let is_planar = self.dimension == Dimension::Planar;
        let [a, v, w] = self.axes.map(|axis| turned[0] * axis);
        let xyz: [Vector<T, 3>; 3] = core::array::from_fn(unit);
        let mut hand = |forces: &[Vector<T, 3>], moments: &[Vector<T, 3>]| {
            for &force in forces {
                take(Wrench { force, moment: Vector::zeros() });
            }
            for moment in moments {
                take(Wrench { force: Vector::zeros(), moment: moment * self.length });
            }
        };
        match self.kind {
            JointKind::Revolute if is_planar => hand(&xyz[..2], &[]),
            JointKind::Prismatic if is_planar => hand(&[cross(&xyz[2], &a)], &xyz[2..]),
            JointKind::Weld if is_planar => hand(&xyz[..2], &xyz[2..]),
            JointKind::Revolute => hand(&xyz, &[v, w]),
            JointKind::Prismatic => hand(&[v, w], &xyz),
            JointKind::Weld => hand(&xyz, &xyz),
            JointKind::Spherical => hand(&xyz, &[]),
            JointKind::Universal => {
                hand(&xyz, &[normalised(&cross(&a, &(turned[1] * self.second_axis)))]);
            }
            JointKind::Cylindrical => hand(&[v, w], &[v, w]),
            JointKind::Planar => hand(&[a], &[v, w]),
            JointKind::Distance => {
                hand(&[normalised(&(places(1) - places(0)))], &[]);
                if self.is_hinged {
                    hand(&[a], &[]);
                }
            }
            JointKind::Free => {}
        }
        match (self.is_guided, self.kind) {
            (false, _) => {}
            (true, JointKind::Prismatic) => hand(&[a], &[]),
            (true, _) => hand(&[], &[a]),
        }
    }
}

/// A joint as a carrier of wrenches, its places read off natural coordinates.
#[derive(Debug, Clone)]
pub(super) struct WrenchBasis<T: Real, const D: usize> {
    pub(super) bodies: [BodyId; 2],
    places: [Affine<T, D>; 2],
    transmission: JointWrenches<T>,
}

impl<T: Real, const D: usize> WrenchBasis<T, D> {
    pub(super) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, index: usize) -> Self {
        let joint = &scene.joints[index];
        let is_guided = scene.guides.iter().any(|guide| guide.joint.index() == index);
        Self {
            bodies: joint.bodies,
            places: [0, 1].map(|i| model.point(joint.bodies[i], joint.points[i])),
            transmission: JointWrenches::new(joint, scene.dimension, is_guided, model.length()),
        }
    }

    /// The joint's place on the second body.
    pub(super) fn place(&self, q: &[T]) -> Vector<T, 3> {
        raised(&self.places[1].value(q))
    }

    /// How many directions it has.
    pub(super) fn n_directions(&self) -> usize {
        self.transmission.n_directions()
    }

    /// Hands out its directions, the bodies' rotations being `turned`. Moments are one times the scene's length, so that
    /// all unknowns are forces.
    pub(super) fn directions(
        &self,
        q: &[T],
        turned: [&Matrix<T, 3>; 2],
        take: impl FnMut(Wrench<T>),
    ) {
        self.transmission.directions(|i| raised(&self.places[i].value(q)), turned, take);
    }
}
