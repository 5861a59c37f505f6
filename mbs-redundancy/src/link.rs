//! One joint as constraint rows on the twists of its bodies.

use super::Vector;
use mbs_core::outputs::{JointWrenches, Wrench};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Dimension, Joint};

/// Poses of the bodies of a scene.
pub type Poses = [RigidMotion<f64>];

/// Link of two bodies by one joint.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    pub(crate) joint: Joint<f64>,
    pub(crate) is_guided: bool,
    transmission: JointWrenches<f64>,
}

impl Link {
    pub(crate) fn new(joint: &Joint<f64>, dimension: Dimension, is_guided: bool) -> Self {
        let transmission = JointWrenches::new(joint, dimension, is_guided, 1.0);
        Self { joint: joint.clone(), is_guided, transmission }
    }

    /// Returns the number of rows of the joint's guides; they are the last rows.
    pub(crate) fn n_guided(&self) -> usize {
        self.transmission.n_guided()
    }

    pub(crate) fn n_rows(&self) -> usize {
        self.transmission.n_directions()
    }

    /// Returns the directions (wrenches) of the joint's rows at a pose. Moments are expressed as unit forces at the lever `length` [m].
    pub(crate) fn wrenches(&self, at: &Poses, length: f64) -> Vec<Wrench<f64>> {
        let turned = self.joint.bodies.map(|body| pose(at, body).rotation);
        let mut all = Vec::with_capacity(self.n_rows());
        let take = |mut w: Wrench<f64>| {
            w.moment *= length;
            all.push(w);
        };
        self.transmission.directions(|i| self.place(at, i), [&turned[0], &turned[1]], take);
        all
    }

    /// Returns the position of the joint's point on its first or second body [m].
    pub(crate) fn place(&self, at: &Poses, i: usize) -> Vector {
        let reference = Vector::from(self.joint.points[i]);
        pose(at, self.joint.bodies[i]).point(&reference)[0]
    }
}

/// Returns the pose of a body; the ground has the pose at rest.
pub(crate) fn pose(at: &Poses, body: BodyId) -> RigidMotion<f64> {
    match body {
        BodyId::Ground => RigidMotion::at_rest(Vector::zeros()),
        BodyId::Body(b) => at[b],
    }
}
