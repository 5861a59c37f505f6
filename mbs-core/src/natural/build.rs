//! From a scene to a [`NaturalModel`]: sharing, bases, rigid-body rows, joint rows, effects.

use super::basis::{Basis, Combination};
use super::draft::{GroupDraft, RowDraft, constant_entity};
use super::error::ModelError;
use super::finish::finish;
use super::model::NaturalModel;
use super::rigid::rigid_rows;
use super::sharing::{Entity, EntityKind, Sharing};
use crate::Real;
use crate::actions::{Action, Actions};
use crate::algebra::{Vector, norm};
use crate::cluster::{Clusters, scene_length};
use crate::model::Owner;
use crate::scene::{BodyRef, Dimension, InitialTarget, JointKind, Quantity, Scene};
use alloc::vec::Vec;

/// Dependent entities that share an element with their body; each further one is an element of its own.
const TOGETHER: usize = 2;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Builds the smallest natural-coordinate model of a scene.
    ///
    /// # Errors
    /// [`ModelError`] when the scene's dimension is not D, or a body's data leave a point undefined.
    pub fn new(scene: &Scene<T>) -> Result<Self, ModelError> {
        if scene.dimension.count() != D {
            return Err(ModelError::Dimension);
        }
        let actions = Actions::new(scene)?;
        let mut builder = Builder::new(scene, &actions)?;
        builder.add_bodies();
        for joint in 0..scene.joints.len() {
            builder.add_joint(joint);
        }
        builder.add_guides();
        builder.add_effects(&actions.list)?;
        Ok(finish(builder, actions))
    }
}

/// Everything known while a model is built.
pub(super) struct Builder<'a, T: Real> {
    pub(super) scene: &'a Scene<T>,
    pub(super) length: T,
    pub(super) clusters: Clusters<T>,
    pub(super) entities: Vec<Entity<T>>,
    pub(super) bases: Vec<Basis<T>>,
    pub(super) shared: Vec<Vec<usize>>,
    pub(super) groups: Vec<GroupDraft<T>>,
    /// Group of each joint that has rows.
    joint_group: Vec<Option<usize>>,
}

impl<'a, T: Real> Builder<'a, T> {
    fn new(scene: &'a Scene<T>, actions: &Actions<T>) -> Result<Self, ModelError> {
        let length = scene_length(scene);
        let clusters = Clusters::new(scene);
        let Sharing { mut entities, of_cluster: shared } = Sharing::new(scene, &clusters, length);
        let mut bases = Vec::with_capacity(shared.len());
        for (c, cluster) in clusters.clusters.iter().enumerate() {
            let basis = match (scene.dimension, &cluster.rod) {
                (Dimension::Planar, _) => Basis::planar(cluster, &shared[c], &mut entities),
                (Dimension::Spatial, Some(ends))
                    if stays_rod((scene, actions), cluster.bodies[0], ends, length) =>
                {
                    Basis::rod(ends, &shared[c], &mut entities)
                }
                (Dimension::Spatial, _) => Basis::spatial(cluster, &shared[c], &mut entities)
                    .ok_or(ModelError::Basis { body: cluster.bodies[0] })?,
            };
            bases.push(basis);
        }
        Ok(Self {
            scene,
            length,
            clusters,
            entities,
            bases,
            shared,
            groups: Vec::new(),
            joint_group: alloc::vec![None; scene.joints.len()],
        })
    }

    /// The combination that is material point `at` of a body.
    pub(super) fn point(&mut self, body: BodyRef, at: [T; 3]) -> Combination<T> {
        let at = Vector::from(at);
        match self.clusters.of(body) {
            Some(c) => self.bases[c].point(&at),
            None => self.constant(at, EntityKind::Point),
        }
    }

    /// The combination that is body-fixed direction `d` of a body.
    pub(super) fn direction(&mut self, body: BodyRef, d: Vector<T, 3>) -> Combination<T> {
        match self.clusters.of(body) {
            Some(c) => self.bases[c].direction(&d),
            None => self.constant(d, EntityKind::Direction),
        }
    }

    fn constant(&mut self, at: Vector<T, 3>, kind: EntityKind) -> Combination<T> {
        let e = constant_entity(at, kind, &mut self.entities);
        alloc::vec![(e, crate::algebra::Coef::one())]
    }

    /// One group for each cluster: mass, gravity, rigid-body rows, dependent points.
    fn add_bodies(&mut self) {
        let zero = constant_entity(Vector::zeros(), EntityKind::Direction, &mut self.entities);
        let rigid = rigid_rows((&self.bases, &self.shared), &self.entities, zero);
        for (c, rows) in rigid.into_iter().enumerate() {
            let cluster = &self.clusters.clusters[c];
            let basis = &self.bases[c];
            let mut group = GroupDraft::new(Owner::Body(cluster.bodies[0]));
            group.mass = Some((basis.entities.clone(), basis.mass_matrix(cluster)));
            if let Some(g) = self.scene.gravity {
                let weight = Vector::<T, 3>::from(g) * cluster.mass;
                for (e, coef) in basis.point(&cluster.center) {
                    group.forces.push((e, super::finish::lifted(coef, &weight)));
                }
            }
            group.rows = rows;
            let owner = group.owner;
            self.groups.push(group);
            let dependent = self.shared[c].iter().filter(|e| !basis.entities.contains(e));
            for (i, &e) in dependent.enumerate() {
                let entity = self.entities[e];
                let x = match entity.kind {
                    EntityKind::Point => basis.point(&entity.at),
                    EntityKind::Direction => basis.direction(&entity.at),
                };
                let x =
                    super::draft::difference(&x, &alloc::vec![(e, crate::algebra::Coef::one())]);
                // The block of a hub with many joints would grow like the square of their number.
                if i >= TOGETHER {
                    self.groups.push(GroupDraft::new(owner));
                }
                if let Some(group) = self.groups.last_mut() {
                    group.rows.push(RowDraft::Linear { x });
                }
            }
        }
    }

    /// The group of a joint, made when first asked for.
    pub(super) fn joint_group(&mut self, joint: usize) -> &mut GroupDraft<T> {
        let index = match self.joint_group[joint] {
            Some(index) => index,
            None => {
                self.groups.push(GroupDraft::new(Owner::Joint(joint)));
                let index = self.groups.len() - 1;
                self.joint_group[joint] = Some(index);
                index
            }
        };
        &mut self.groups[index]
    }
}

/// May a spatial rod stay two points? Only balls hold it, every point used lies on it, nothing needs its spin.
fn stays_rod<T: Real>(
    (scene, actions): (&Scene<T>, &Actions<T>),
    body: usize,
    ends: &[Vector<T, 3>; 2],
    length: T,
) -> bool {
    let me = BodyRef::Body(body);
    let along = ends[1] - ends[0];
    let on_line = |p: &[T; 3]| {
        let r = Vector::<T, 3>::from(*p) - ends[0];
        let off = r - along * (r.dot(&along) / along.dot(&along));
        norm(&off)
            <= length * T::from_f64(super::sharing::TOLERANCE).max(T::EPSILON * T::from_f64(64.0))
    };
    let joints_allow = scene.joints.iter().all(|j| {
        let side = j.bodies.iter().position(|b| *b == me);
        side.is_none_or(|side| {
            let is_ball = j.kind == JointKind::Spherical
                || (j.kind == JointKind::Distance && (j.axes[0].is_none() || side == 1));
            is_ball && on_line(&j.points[side])
        })
    });
    let initials_allow = scene.initials.iter().all(|i| match &i.target {
        InitialTarget::Body { body: b, velocity, angular_velocity } => {
            *b != body
                || (angular_velocity.is_none() && velocity.as_ref().is_none_or(|(p, _)| on_line(p)))
        }
        InitialTarget::Joint { joint, .. } => !scene.joints[*joint].bodies.contains(&me),
    });
    let effects_allow = actions.list.iter().all(|(_, action)| match action {
        Action::Length { ends, .. } => ends.iter().all(|(b, p)| *b != me || on_line(p)),
        Action::Along { ends, .. } => ends[0].0 != me && (ends[1].0 != me || on_line(&ends[1].1)),
        Action::Twist { bodies, .. } => !bodies.contains(&me),
        Action::Constant { at, .. } => at.0 != body || on_line(&at.1),
        Action::Force { at, turns, .. } => at.0 != body || (on_line(&at.1) && !turns),
        Action::Torque { body: b, .. } => *b != body,
        Action::OnBody { at, law, .. } => at.0 != body || (on_line(&at.1) && !law.needs_rotation()),
        Action::Angle { joint, .. } => !scene.joints[*joint].bodies.contains(&me),
    });
    let outputs_allow = scene.outputs.iter().all(|o| match &o.quantity {
        Quantity::Position { body: b, at }
        | Quantity::Velocity { body: b, at }
        | Quantity::Acceleration { body: b, at } => *b != body || on_line(&at.map(T::from_f64)),
        _ => true,
    });
    joints_allow && initials_allow && effects_allow && outputs_allow
}
