//! Which spatial rods may stay two points: only balls hold them, every point used lies on them, nothing needs their spin.

use crate::Real;
use crate::actions::{Action, Actions};
use crate::algebra::{Vector, cross, norm};
use crate::cluster::{Cluster, Clusters};
use crate::outputs::{RelativePoint, Target};
use crate::scene::{BallAngle, BodyId, CouplingMeasure, InitialTarget, Scene};
use alloc::vec;
use alloc::vec::Vec;

/// The rods of a scene that nothing has asked for more than two points. One pass over the scene asks for all.
#[derive(Debug)]
pub(super) struct ThinRods<T: Real> {
    /// Ends of each body that is such a rod.
    ends: Vec<Option<[Vector<T, 3>; 2]>>,
    /// Distance from the line that counts as on it [m].
    tolerance: T,
}

impl<T: Real> ThinRods<T> {
    pub(super) fn new(
        (scene, actions): (&Scene<T>, &Actions<T>),
        clusters: &Clusters<T>,
        length: T,
    ) -> Self {
        let relative = super::sharing::tolerance::<T>();
        let mut ends = vec![None; scene.bodies.len()];
        for cluster in &clusters.clusters {
            if let (Some(rod), Some(&body)) = (cluster.rod, cluster.bodies.first()) {
                ends[body] = Some(rod);
            }
        }
        let mut rods = Self { ends, tolerance: length * relative };
        rods.ask_joints(scene);
        for guide in &scene.guides {
            scene.joints[guide.joint].bodies.into_iter().for_each(|body| rods.rotation(body));
        }
        rods.ask_initials(scene);
        actions.list.iter().for_each(|(_, action)| rods.ask_action(scene, action));
        let terms = scene.couplings.iter().flat_map(|coupling| &coupling.terms);
        for term in terms.filter(|term| !term.factor.is_zero()) {
            rods.ask_measure(scene, &term.of);
        }
        for rolling in &scene.rollings {
            [rolling.body, rolling.on].into_iter().for_each(|body| rods.rotation(body));
        }
        for (joint, _) in actions.prescribed.feedback().measured {
            scene.joints[joint].bodies.into_iter().for_each(|body| rods.rotation(body));
        }
        for output in &scene.outputs {
            match output.quantity.target() {
                Target::Point(body, at) => rods.point(body, &at),
                Target::RelativePoint(RelativePoint { body, at, relative_to, origin }) => {
                    rods.point(body, &at);
                    rods.point(relative_to, &origin);
                }
                _ => {}
            }
        }
        rods
    }

    /// Ends of a cluster that stays two points.
    pub(super) fn of_cluster(&self, cluster: &Cluster<T>) -> Option<&[Vector<T, 3>; 2]> {
        let body = cluster.bodies.first()?;
        self.ends.get(*body)?.as_ref()
    }

    /// A point of a body is used: it must lie on the line.
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

    /// The whole rotation of a body is used.
    fn rotation(&mut self, body: BodyId) {
        if let BodyId::Body(b) = body {
            self.ends[b] = None;
        }
    }

    fn ask_joints(&mut self, scene: &Scene<T>) {
        // a free joint has no row
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

    fn ask_initials(&mut self, scene: &Scene<T>) {
        for initial in &scene.initials {
            match &initial.target {
                InitialTarget::Body { body, velocity, .. } => {
                    // an angular velocity says how the line swings
                    if let Some((at, _)) = velocity {
                        self.point(*body, at);
                    }
                }
                InitialTarget::Joint { joint, .. } => {
                    scene.joints[*joint].bodies.into_iter().for_each(|body| self.rotation(body));
                }
            }
        }
    }

    fn ask_action(&mut self, scene: &Scene<T>, action: &Action<T>) {
        match action {
            Action::Length { ends, .. } => ends.iter().for_each(|(b, p)| self.point(*b, p)),
            Action::Along { ends, .. } => {
                self.rotation(ends[0].0);
                self.point(ends[1].0, &ends[1].1);
            }
            Action::Turn { bodies, .. } | Action::Rotation { bodies, .. } => {
                bodies.iter().for_each(|b| self.rotation(*b))
            }
            Action::Constant { at: (body, at), .. } => self.point(BodyId::Body(*body), at),
            Action::Torque { body, .. } => self.rotation(BodyId::Body(*body)),
            Action::Sum { terms, .. } => {
                terms.iter().for_each(|term| self.ask_measure(scene, &term.of));
            }
            Action::Angle { joint, .. } => {
                scene.joints[*joint].bodies.into_iter().for_each(|body| self.rotation(body));
            }
            Action::Force { at: (body, at), turns, .. } => {
                self.point_turning(*body, at, *turns);
            }
            Action::BodyLoad { at: (body, at), law, .. } => {
                self.point_turning(*body, at, law.needs_rotation());
            }
        }
    }

    fn ask_measure(&mut self, scene: &Scene<T>, of: &CouplingMeasure<T>) {
        match of {
            CouplingMeasure::Length { points } => {
                points.iter().for_each(|(b, p)| self.point(*b, p));
            }
            CouplingMeasure::Ball { joint, angle: BallAngle::Swing, axis } => {
                let joint = &scene.joints[joint.index()];
                joint.bodies.into_iter().for_each(|body| self.along(body, axis));
            }
            CouplingMeasure::Ball { joint, .. } | CouplingMeasure::Coordinate { joint, .. } => {
                let joint = &scene.joints[joint.index()];
                joint.bodies.into_iter().for_each(|body| self.rotation(body));
            }
        }
    }

    /// A direction of a body is used: along the line of a rod it is that of two points.
    fn along(&mut self, body: BodyId, axis: &[T; 3]) {
        let BodyId::Body(b) = body else { return };
        let Some([from, to]) = self.ends[b] else { return };
        let (line, axis) = (to - from, Vector::<T, 3>::from(*axis));
        let off = norm(&cross(&line, &axis)) / norm(&axis);
        if !(off <= self.tolerance) {
            self.ends[b] = None;
        }
    }

    fn point_turning(&mut self, body: usize, at: &[T; 3], turns: bool) {
        let me = BodyId::Body(body);
        if turns {
            self.rotation(me);
        } else {
            self.point(me, at);
        }
    }
}
