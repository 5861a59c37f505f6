//! Facts of each joint and each cluster of a scene, collected in one pass.

use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::cluster::{Clusters, is_on_line};
use mbs_core::scene::{BodyId, CouplingMeasure, Scene};

/// The guide of each joint, and for each cluster whether it is a thin rod without spin.
pub(crate) struct JointFacts {
    /// First guide of each joint, if any.
    pub(crate) guide: Vec<Option<usize>>,
    /// True for each cluster that is a thin rod which no joint, coupling or rolling can turn about its line.
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
                let Some(rod) = cluster.rod else { continue };
                let is_loose = joint.kind.is_free()
                    || (joint.is_ball_at(i) && is_on_line(&rod, joint.points[i]));
                is_idle[c] &= is_loose && guide[j].is_none();
            }
        }
        let mut ends_at = |body: BodyId, point: Option<[T; 3]>| {
            let Some(c) = clusters.of(body) else { return };
            let Some(rod) = clusters.clusters[c].rod else { return };
            is_idle[c] &= point.is_some_and(|point| is_on_line(&rod, point));
        };
        for term in scene.couplings.iter().flat_map(|coupling| &coupling.terms) {
            if let CouplingMeasure::Length { points } = &term.of {
                points.iter().for_each(|&(body, point)| ends_at(body, Some(point)));
            }
        }
        for rolling in &scene.rollings {
            ends_at(rolling.body, None);
            ends_at(rolling.on, None);
        }
        Self { guide, is_idle }
    }
}
