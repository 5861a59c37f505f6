//! Factors of gravity on single bodies. The whole tree has full gravity; forces at the centres of mass add the difference.
//!
//! ```text
//! F = m g (s − 1)        s: the body's `gravity_scale`
//! ```

use crate::build::tree::TreeModel;
use crate::loads::Load;
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::cluster::mass_properties;
use mbs_core::scene::{BodyId, Scene};

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Adds the forces that correct gravity as the first loads. Bodies that cannot move are skipped.
    pub(crate) fn add_weights(&mut self, scene: &Scene<T>) {
        for (b, body) in scene.bodies.iter().enumerate() {
            let Some(scale) = body.gravity_scale else { continue };
            let (mass, center, _) = mass_properties(scene, b);
            let (link, point) = self.seat_point(BodyId::Body(b), center.into());
            let force = self.gravity * (mass * (scale - T::ONE));
            let load = Load::Constant { link, point, force };
            if force.parts(&force) > T::ZERO && !load.is_idle() {
                self.loads.push(load);
            }
        }
        self.n_weights = self.loads.len();
        // these loads belong to no effect
        self.effects.resize(self.n_weights, usize::MAX);
    }

    /// Returns the loads that represent factors of gravity.
    pub(crate) fn weights(&self) -> &[Load<T, S>] {
        &self.loads[..self.n_weights]
    }
}
