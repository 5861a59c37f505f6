//! Outputs by what they measure, and the components of a quantity.

use super::components::Component;
use super::{Quantity, Target};
use crate::scene::{BodyId, JointId, Number, Output, Scene, Vector3};
use alloc::vec::Vec;

super::list::list!(constructors);

impl<T: Clone> Quantity<T> {
    /// Its components in a scene.
    ///
    /// # Panics
    /// If it is of a joint that is not there; [`Scene::check`] refuses those.
    #[must_use]
    pub fn components(&self, scene: &Scene<T>) -> Vec<Component> {
        let freedoms = match self.target() {
            Target::Joint(joint) => scene.joints[joint].kind.freedoms(scene.dimension),
            Target::Point(..) | Target::Body(_) => &[],
        };
        self.row().components.of(scene.dimension, freedoms)
    }
}
