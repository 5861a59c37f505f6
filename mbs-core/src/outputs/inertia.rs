//! Energy and momentum of bodies at a state.
//!
//! ```text
//! E = 1/2 sum (m c'.c' + omega.I omega),   V = -sum s m g.c,   P = sum m c'
//! L = sum (I omega + m (c - C) x (c' - C'))      C: the common centre of mass
//! ```
//!
//! E and V are kinetic and potential energy, P and L momentum and angular momentum. m is the mass of a body, c its centre of mass, I its
//! inertia, omega its angular velocity, and s its gravity scale. g is gravity.

use super::frame::Frame;
use crate::Real;
use crate::algebra::{Matrix, Vector, cross, raised};
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::{Affine, NaturalModel};
use crate::scene::BodyId;

/// Mass properties of a body, with its frame.
#[derive(Debug, Clone)]
pub(super) struct BodyInertia<T: Real, const D: usize> {
    pub(super) frame: Frame<T, D>,
    pub(super) center: Affine<T, D>,
    /// Mass of the body [kg].
    pub(super) mass: T,
    /// Mass on which gravity acts [kg].
    weight: T,
    /// Inertia about the centre of mass, in the reference configuration [kg m^2].
    pub(super) inertia: Matrix<T, 3>,
}

impl<T: Real, const D: usize> BodyInertia<T, D> {
    /// Prepares the inertia of `scene.bodies[body]`.
    pub(super) fn new(scene: &Scene<T>, model: &NaturalModel<T, D>, body: usize) -> Self {
        let (mass, center, inertia) = scene.bodies[body].mass_properties();
        let me = BodyId::Body(body);
        let (frame, center) = (Frame::new(model, me), model.point(me, center.into()));
        Self { frame, center, mass, weight: scene.bodies[body].gravitational_mass(), inertia }
    }

    /// Position of the centre of mass, and its velocity [m, m/s].
    fn center(&self, state: &State<T>) -> [Vector<T, 3>; 2] {
        [raised(&self.center.value(&state.q)), raised(&self.center.rate(&state.v))]
    }

    /// Angular velocity omega, and the angular momentum I omega, in global axes.
    fn spin(&self, state: &State<T>) -> [Vector<T, 3>; 2] {
        let (r, omega) = (self.frame.rotation(&state.q), self.frame.turning(&state.q, &state.v));
        [omega, r * (self.inertia * (r.transpose() * omega))]
    }

    /// Kinetic energy of the body [J].
    pub(super) fn kinetic_energy(&self, state: &State<T>) -> T {
        let ([_, v], [omega, spin]) = (self.center(state), self.spin(state));
        (v.dot(&v) * self.mass + omega.dot(&spin)) * T::HALF
    }
}

/// The kinetic energy of bodies [J].
pub(super) fn kinetic_energy<T: Real, const D: usize>(
    bodies: &[BodyInertia<T, D>],
    state: &State<T>,
) -> T {
    bodies.iter().fold(T::ZERO, |sum, body| sum + body.kinetic_energy(state))
}

/// Potential energy of bodies in a field of gravity [J]; zero at the origin.
pub(super) fn potential_energy<T: Real, const D: usize>(
    bodies: &[BodyInertia<T, D>],
    gravity: &Vector<T, 3>,
    state: &State<T>,
) -> T {
    let height = |body: &BodyInertia<T, D>| gravity.dot(&body.center(state)[0]);
    bodies.iter().fold(T::ZERO, |sum, body| sum - body.weight * height(body))
}

/// The momentum of bodies [kg m/s].
pub(super) fn momentum<T: Real, const D: usize>(
    bodies: &[BodyInertia<T, D>],
    state: &State<T>,
) -> Vector<T, 3> {
    bodies.iter().fold(Vector::zeros(), |sum, body| sum + body.center(state)[1] * body.mass)
}

/// Centre of mass of bodies [m] and its velocity [m/s]. It is the origin if the bodies have no mass.
pub(super) fn center<T: Real, const D: usize>(
    bodies: &[BodyInertia<T, D>],
    state: &State<T>,
) -> [Vector<T, 3>; 2] {
    let mass = bodies.iter().fold(T::ZERO, |sum, body| sum + body.mass);
    let inverse = if mass > T::ZERO { T::ONE / mass } else { T::ZERO };
    let place = |sum, body: &BodyInertia<T, D>| sum + body.center(state)[0] * body.mass;
    let place: Vector<T, 3> = bodies.iter().fold(Vector::zeros(), place);
    [place * inverse, momentum(bodies, state) * inverse]
}

/// Angular momentum of bodies about their common centre of mass [kg m^2/s].
pub(super) fn angular_momentum<T: Real, const D: usize>(
    bodies: &[BodyInertia<T, D>],
    state: &State<T>,
) -> Vector<T, 3> {
    let [middle, v_middle] = center(bodies, state);
    bodies.iter().fold(Vector::zeros(), |sum, body| {
        let ([c, v], [_, spin]) = (body.center(state), body.spin(state));
        sum + spin + cross(&(c - middle), &(v - v_middle)) * body.mass
    })
}
