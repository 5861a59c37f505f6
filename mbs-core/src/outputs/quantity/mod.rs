//! The quantities of outputs, a file each: name in scene files, components with their units, and how it is read of a state.
//!
//! The list below is all that the rest of the workspace knows of them. A line has what the quantity is, its kind and its module, under what it
//! is of. The first line of a body's or a joint's is the quantity where a scene file names none. The module is the constructor's name.

mod components;
mod kind;
mod table;

pub use components::{Component, ComponentForm};
use kind::Measured;
pub(super) use kind::{Instant, Maker};
pub use kind::{QuantityRow, Target, TargetKind};

use crate::Real;
use crate::scene::{BodyId, JointId, Number, Output, Scene, Vector3};
use alloc::vec::Vec;

table::quantities! {
    point {
        /// Position of a point of a body [m], global axes.
        Position in position;
        /// Velocity of a point of a body [m/s], global axes.
        Velocity in velocity;
        /// Acceleration of a point of a body [m/s^2], global axes.
        Acceleration in acceleration;
    }
    body {
        /// Angular velocity of a body [rad/s], global axes; in the plane one number. Of a thin rod that balls alone hold, the part across it.
        AngularVelocity in angular_velocity;
    }
    joint {
        /// Coordinates of a joint [rad or m], turns counted.
        JointValue in value;
        /// Rates of a joint [rad/s or m/s].
        JointRate in rate;
        /// What a joint's first body does to the second at the joint's place [N, N m]: planar [Fx, Fy, Mz], spatial [Fx, Fy, Fz, Mx, My, Mz].
        Reaction in reaction;
    }
}

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
