//! Motion of a body, computed from natural coordinates.

use super::frame::Frame;
use crate::Real;
use crate::algebra::{Vector, raised};
use crate::mechanism::Scene;
use crate::model::State;
use crate::natural::NaturalModel;
use crate::rigid::RigidMotion;
use crate::scene::BodyId;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Motion of `scene.bodies[body]` about its centre of mass at a state. A thin rod between ball joints has no spin about its axis: its
    /// rotation is the smallest one that turns its line.
    ///
    /// It allocates, and is for starts and reports, not for steps.
    #[must_use]
    pub fn motion(&self, scene: &Scene<T>, body: usize, state: &State<T>) -> RigidMotion<T> {
        let (_, center, _) = crate::cluster::mass_properties(scene, body);
        let owner = BodyId::Body(body);
        if self.is_ground(owner) {
            return RigidMotion::at_rest(center);
        }
        let (point, frame) = (self.point(owner, center.into()), Frame::new(self, owner));
        let [position, velocity, acceleration] =
            [point.value(&state.q), point.rate(&state.v), point.rate(&state.a)]
                .map(|x: Vector<T, D>| raised(&x));
        RigidMotion {
            origin: center,
            position,
            rotation: frame.rotation(&state.q),
            omega: frame.turning(&state.q, &state.v),
            velocity,
            angular_acceleration: frame.turning(&state.q, &state.a),
            acceleration,
        }
    }
}
