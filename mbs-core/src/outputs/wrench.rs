//! Wrenches that a joint can transmit, as directions in global axes at the joint's point on the second body.
//!
//! | freedoms | forces; moments |
//! |---|---|
//! | no slide; slides | all; across the slides, in the first body |
//! | no turn | all; plane: about z |
//! | one turn | across its axis, in the first body; plane: none |
//! | two turns | a x b |
//! | ball | none |
//! | link | along the link; if hinged, also along the hinge axis a |
//!
//! a and b are the joint's axes. A guide adds the direction in which it drives: the moment about the axis, or the force along it. For a
//! rotation vector it adds all moments.

use super::frame::normalised;
use crate::Real;
use crate::algebra::{Matrix, Vector, cross, raised, unit};
use crate::joint::{Axis, Dimension, Freedom, Rotation, Translation};
use crate::measure::{RollingInput, lowest_place};
use crate::mechanism::Scene;
use crate::natural::{Affine, NaturalModel};
use crate::scene::{BodyId, Joint, transverse};
use alloc::vec::Vec;

/// Wrench with a body and, for a force, the point at which it acts.
pub(super) type Applied<T> = (BodyId, Option<Vector<T, 3>>, Wrench<T>);

/// Force and moment [N, N m]. The moment is about the joint's point or about a body's centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wrench<T: Real> {
    /// Force in global axes [N].
    pub force: Vector<T, 3>,
    /// Moment in global axes [N m].
    pub moment: Vector<T, 3>,
}

impl<T: Real> Wrench<T> {
    pub(super) fn zero() -> Self {
        Self { force: Vector::zeros(), moment: Vector::zeros() }
    }

    /// The wrench times a number.
    pub(super) fn scaled(&self, s: T) -> Self {
        Self { force: self.force * s, moment: self.moment * s }
    }

    /// Adds another wrench about the same point.
    pub(super) fn add(&mut self, other: &Self) {
        self.force += other.force;
        self.moment += other.moment;
    }

    /// This wrench about another point. `arm` is the vector from that point to the present one.
    pub(super) fn shifted(&self, arm: &Vector<T, 3>) -> Self {
        Self { force: self.force, moment: self.moment + cross(arm, &self.force) }
    }
}

/// Wrenches that a joint can transmit, from its kind and axes alone. Directions are those of the reference configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct JointWrenches<T: Real> {
    dimension: Dimension,
    translation: Translation,
    rotation: Rotation,
    /// Directions of forces, fixed in the first body, if the joint slides. `moments` are directions of moments if the joint turns about one
    /// axis.
    forces: Vec<Vector<T, 3>>,
    moments: Vec<Vector<T, 3>>,
    /// Axes in the first and the second body if the joint turns about two axes.
    crossed: [Vector<T, 3>; 2],
    is_link: bool,
    /// Hinge axis of a hinged link.
    hinge: Option<Vector<T, 3>>,
    /// Guided freedoms, with the body (0 or 1) in which the axis is fixed, and the axis. The axis of a ball is zero.
    guided: Vec<(Freedom, usize, Vector<T, 3>)>,
    length: T,
}

impl<T: Real> JointWrenches<T> {
    /// Wrenches of a joint in a checked scene. Moments are unit forces at a lever of `length` [m], so that all directions have the unit of
    /// a force.
    #[must_use]
    pub fn new(joint: &Joint<T>, dimension: Dimension, is_guided: bool, length: T) -> Self {
        let rotation = joint.kind.rotation(dimension);
        let (moments, crossed) = match rotation {
            Rotation::About(axis) => {
                let axis = joint.direction(axis);
                (transverse(&axis, dimension).to_vec(), [axis; 2])
            }
            Rotation::Universal(axes) => (Vec::new(), axes.map(|axis| joint.direction(axis))),
            Rotation::Fixed | Rotation::Free => (Vec::new(), [Vector::zeros(); 2]),
        };
        let guided = joint.freedoms(dimension).iter().filter(|_| is_guided).map(|&freedom| {
            let side = match freedom {
                Freedom::Turn(axis) => joint.side_of_turn(dimension, axis),
                Freedom::Slide(_) | Freedom::Ball => 0,
            };
            let axis = freedom.axis().map_or_else(Vector::zeros, |axis| joint.direction(axis));
            (freedom, side, axis)
        });
        Self {
            dimension,
            translation: joint.kind.translation(dimension),
            rotation,
            forces: joint.across_slides(dimension).collect(),
            moments,
            crossed,
            is_link: joint.kind.is_link(),
            hinge: joint.is_hinged_link().then(|| joint.direction(Axis::First)),
            guided: guided.collect(),
            length,
        }
    }

    /// Number of directions that guides add. These directions are the last ones.
    #[must_use]
    pub fn n_guided(&self) -> usize {
        self.guided.iter().map(|(freedom, ..)| freedom.n_coordinates()).sum()
    }

    /// Number of directions of the joint.
    #[must_use]
    pub fn n_directions(&self) -> usize {
        let n_forces = match self.translation {
            Translation::Fixed => self.dimension.count(),
            Translation::Along(_) | Translation::Across(_) | Translation::Free => self.forces.len(),
        };
        let n_moments = match self.rotation {
            Rotation::Fixed => 2 * self.dimension.count() - 3,
            Rotation::Universal(_) => 1,
            Rotation::About(_) | Rotation::Free => self.moments.len(),
        };
        let n_link = usize::from(self.is_link) + usize::from(self.hinge.is_some());
        n_forces + n_moments + n_link + self.n_guided()
    }

    /// Passes the directions of the wrenches to `take`. `places` are the joint's points on both bodies [m], `turned` the rotation matrices
    /// of the bodies.
    pub fn directions(
        &self,
        places: impl Fn(usize) -> Vector<T, 3>,
        turned: [&Matrix<T, 3>; 2],
        mut take: impl FnMut(Wrench<T>),
    ) {
        let xyz: [Vector<T, 3>; 3] = core::array::from_fn(unit);
        let d = self.dimension.count();
        let mut force = |force| take(Wrench { force, moment: Vector::zeros() });
        match self.translation {
            Translation::Fixed => xyz[..d].iter().copied().for_each(&mut force),
            Translation::Along(_) | Translation::Across(_) | Translation::Free => {
                self.forces.iter().for_each(|u| force(turned[0] * u));
            }
        }
        if self.is_link {
            force(normalised(&(places(1) - places(0))));
        }
        self.hinge.iter().for_each(|axis| force(turned[0] * axis));
        let moment = |m: Vector<T, 3>| Wrench { force: Vector::zeros(), moment: m * self.length };
        match self.rotation {
            Rotation::Fixed => xyz[6 - 2 * d..].iter().for_each(|m| take(moment(*m))),
            Rotation::Universal(_) => {
                let [a, b] = [0, 1].map(|side| turned[side] * self.crossed[side]);
                take(moment(normalised(&cross(&a, &b))));
            }
            Rotation::About(_) | Rotation::Free => {
                self.moments.iter().for_each(|m| take(moment(turned[0] * m)));
            }
        }
        for &(freedom, side, axis) in &self.guided {
            match (freedom, turned[side] * axis) {
                (Freedom::Slide(_), axis) => take(Wrench { force: axis, moment: Vector::zeros() }),
                (Freedom::Turn(_), axis) => take(moment(axis)),
                (Freedom::Ball, _) => xyz.iter().for_each(|m| take(moment(*m))),
            }
        }
    }
}

/// Wrench basis of a joint or a rolling contact, with its points in natural coordinates.
#[derive(Debug, Clone)]
pub(super) struct WrenchBasis<T: Real, const D: usize> {
    /// First body, from which a wrench acts, and second body, on which it acts.
    pub(super) bodies: [BodyId; 2],
    places: [Affine<T, D>; 2],
    transmission: Transmission<T>,
}

/// Wrenches that a joint or a rolling contact transmits.
#[derive(Debug, Clone)]
enum Transmission<T: Real> {
    Joint(JointWrenches<T>),
    /// Forces at the lowest point, along the normal and in the plane. A blade transmits a force in the plane that is perpendicular to the
    /// blade.
    Rolling(RollingInput<T>),
}

impl<T: Real, const D: usize> WrenchBasis<T, D> {
    /// Wrenches of the rolling contact `scene.rollings[index]`, from the plane's body on the rolling body.
    pub(super) fn of_rolling(scene: &Scene<T>, model: &NaturalModel<T, D>, index: usize) -> Self {
        let input = RollingInput::new(&scene.rollings[index], scene.dimension);
        let [body, on] = input.bodies;
        Self {
            bodies: [on, body],
            places: [model.point(on, input.base.into()), model.point(body, input.center.into())],
            transmission: Transmission::Rolling(input),
        }
    }

    pub(super) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, index: usize) -> Self {
        let joint = &scene.joints[index];
        let is_guided = scene.guides.iter().any(|guide| guide.joint.index() == index);
        Self {
            bodies: joint.bodies,
            places: [0, 1].map(|i| model.point(joint.bodies[i], joint.points[i])),
            transmission: Transmission::Joint(JointWrenches::new(
                joint,
                scene.dimension,
                is_guided,
                model.length(),
            )),
        }
    }

    /// The joint's point on the second body, or the lowest point of a rolling body. `turned` are the rotation matrices of the bodies.
    pub(super) fn place(&self, q: &[T], turned: [&Matrix<T, 3>; 2]) -> Vector<T, 3> {
        let place = raised(&self.places[1].value(q));
        match &self.transmission {
            Transmission::Rolling(RollingInput {
                is_blade: false, radius, plane, axis, ..
            }) => place + lowest_place(*radius, turned[0] * plane[0], turned[1] * axis),
            Transmission::Rolling(_) | Transmission::Joint(_) => place,
        }
    }

    /// Normal of the plane on which a body rolls; zero for a joint. `turned` is the rotation matrix of the plane's body.
    pub(super) fn normal(&self, turned: &Matrix<T, 3>) -> Vector<T, 3> {
        match &self.transmission {
            Transmission::Rolling(input) => turned * input.plane[0],
            Transmission::Joint(_) => Vector::zeros(),
        }
    }

    /// Number of directions of the basis.
    pub(super) fn n_directions(&self) -> usize {
        match &self.transmission {
            Transmission::Joint(joint) => joint.n_directions(),
            Transmission::Rolling(input) if input.is_blade => 1,
            Transmission::Rolling(_) => D,
        }
    }

    /// Passes the directions of the basis to `take`. `turned` are the rotation matrices of the bodies. Moments are unit forces times the
    /// scene's length, so that all unknowns are forces.
    pub(super) fn directions(
        &self,
        q: &[T],
        turned: [&Matrix<T, 3>; 2],
        take: &mut dyn FnMut(Wrench<T>),
    ) {
        let input = match &self.transmission {
            Transmission::Joint(joint) => {
                return joint.directions(|i| raised(&self.places[i].value(q)), turned, take);
            }
            Transmission::Rolling(input) => input,
        };
        let mut force = |force| take(Wrench { force, moment: Vector::zeros() });
        if input.is_blade {
            force(cross(&(turned[0] * input.plane[0]), &(turned[1] * input.axis)));
        } else {
            input.plane.iter().take(D).for_each(|u| force(turned[0] * u));
        }
    }
}
