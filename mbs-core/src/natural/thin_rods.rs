//! Spatial rods that two points describe: only ball joints hold them, every used point is on them, and nothing needs their spin.

use crate::Real;
use crate::actions::{Need, needs};
use crate::algebra::{Vector, cross, norm};
use crate::cluster::{Cluster, Clusters};
use crate::effects::action::Actions;
use crate::mechanism::Scene;
use crate::scene::BodyId;
use alloc::vec;
use alloc::vec::Vec;

/// Rods of a scene that two points may describe, because no entry needs more. One pass over the scene checks every need.
#[derive(Debug)]
pub(super) struct ThinRods<T: Real> {
    /// Ends of each body that is a thin rod; `None` for other bodies.
    ends: Vec<Option<[Vector<T, 3>; 2]>>,
    /// Largest distance from the line at which a point counts as on it [m].
    tolerance: T,
}

impl<T: Real> ThinRods<T> {
    pub(super) fn new(
        (scene, actions): (&Scene<T>, &Actions<T>),
        clusters: &Clusters<T>,
        length: T,
    ) -> Self {
        let relative = crate::cluster::point_tolerance::<T>();
        let mut ends = vec![None; scene.bodies.len()];
        for cluster in &clusters.clusters {
            if let Some(rod) = cluster.rod {
                cluster.bodies.iter().for_each(|body| ends[*body] = Some(rod));
            }
        }
        let mut rods = Self { ends, tolerance: length * relative };
        rods.ask_joints(scene);
        needs(scene, actions, &mut |_, need| rods.ask(scene, &need));
        rods
    }

    /// Ends of a cluster that two points describe.
    pub(super) fn of_cluster(&self, cluster: &Cluster<T>) -> Option<&[Vector<T, 3>; 2]> {
        let of_all = cluster.bodies.iter().map(|body| self.ends[*body].as_ref());
        of_all.reduce(|first, next| first.and(next))?
    }

    /// Notes that a point of a body is used. The body stays a thin rod only if the point is on its line.
    fn point(&mut self, body: BodyId, at: &[T; 3]) {
        let BodyId::Body(b) = body else { return };
        let Some(ends) = &self.ends[b] else { return };
        let along = ends[1] - ends[0];
        let r = Vector::<T, 3>::from(*at) - ends[0];
        let off = r - along * (r.dot(&along) / along.dot(&along));
        if !(norm(&off) <= self.tolerance) {
            self.ends[b] = None;
        }
    }

    /// Notes that the whole rotation of a body is used, so that the body is no thin rod.
    fn rotation(&mut self, body: BodyId) {
        if let BodyId::Body(b) = body {
            self.ends[b] = None;
        }
    }

    fn ask_joints(&mut self, scene: &Scene<T>) {
        // a free joint has no constraint row
        for joint in scene.joints.iter().filter(|joint| !joint.kind.is_free()) {
            for (side, body) in joint.bodies.into_iter().enumerate() {
                if joint.is_ball_at(side) {
                    self.point(body, &joint.points[side]);
                } else {
                    self.rotation(body);
                }
            }
        }
    }

    fn ask(&mut self, scene: &Scene<T>, need: &Need<T>) {
        match need {
            Need::Point(body, at) => self.point(*body, at),
            Need::Direction(joint, axis) => {
                scene.joints[*joint].bodies.into_iter().for_each(|body| self.along(body, axis));
            }
            Need::Rotation(body) => self.rotation(*body),
            Need::Coordinates(joint, _) => {
                scene.joints[*joint].bodies.into_iter().for_each(|body| self.rotation(body));
            }
            // a rod gives the orientation of its line
            Need::Orientation(_) => {}
        }
    }

    /// Notes that a direction of a body is used. A direction along the line of a rod follows from its two points.
    fn along(&mut self, body: BodyId, axis: &[T; 3]) {
        let BodyId::Body(b) = body else { return };
        let Some([from, to]) = self.ends[b] else { return };
        let (line, axis) = (to - from, Vector::<T, 3>::from(*axis));
        let off = norm(&cross(&line, &axis)) / norm(&axis);
        if !(off <= self.tolerance) {
            self.ends[b] = None;
        }
    }
}
