//! What a scene says of each joint and each body, gathered in one pass.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross, norm};
use mbs_core::cluster::Clusters;
use mbs_core::scene::{BodyId, Scene};

/// Guides by joint, and thin rods without spin by cluster.
pub(crate) struct JointFacts {
    /// The guide of each joint, of several the first.
    pub(crate) guide: Vec<Option<usize>>,
    /// Is the cluster a thin rod that nothing can turn about itself?
    pub(crate) is_idle: Vec<bool>,
}

impl JointFacts {
    pub(crate) fn new<T: Real>(scene: &Scene<T>, clusters: &Clusters<T>) -> Self {
        let mut guide = vec![None; scene.joints.len()];
        for (g, law) in scene.guides.iter().enumerate() {
            guide[law.joint.index()].get_or_insert(g);
        }
        let mut is_idle: Vec<bool> = clusters.clusters.iter().map(|c| c.rod.is_some()).collect();
        for (j, joint) in scene.joints.iter().enumerate() {
            for (i, &body) in joint.bodies.iter().enumerate() {
                let Some(c) = clusters.of(body) else { continue };
                let cluster = &clusters.clusters[c];
                let (Some(rod), BodyId::Body(b)) = (cluster.rod, body) else { continue };
                let is_loose = joint.kind.is_free()
                    || (joint.is_ball_at(i) && is_on_line(&rod, joint.points[i]));
                is_idle[c] &= b != cluster.bodies[0] || (is_loose && guide[j].is_none());
            }
        }
        Self { guide, is_idle }
    }
}

/// Does a point lie on the line of a rod?
pub(crate) fn is_on_line<T: Real>([from, to]: &[Vector<T, 3>; 2], point: [T; 3]) -> bool {
    let along = to - from;
    let off = T::EPSILON.sqrt() * along.dot(&along);
    norm(&cross(&(Vector::from(point) - from), &along)) <= off
}
