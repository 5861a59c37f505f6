//! Builder of a model: shared entities, bases and rigid-body rows, then joint rows and effects.

use super::basis::{Basis, Combination};
use super::error::ModelError;
use super::rigid::rigid_rows;
use super::row_builder::{Constants, GroupDraft, MeasureDraft, RowDraft};
use super::sharing::{Entity, EntityKind, Sharing};
use super::thin_rods::ThinRods;
use crate::Real;
use crate::algebra::Vector;
use crate::cluster::{Clusters, scene_length};
use crate::effects::action::Actions;
use crate::joint::Dimension;
use crate::mechanism::{RotorInput, Scene};
use crate::model::Owner;
use crate::scene::BodyId;
use alloc::vec::Vec;

/// Largest number of dependent entities in the same element as their body [-]. Each further entity is a separate element. Otherwise
/// the block of a hub with many joints would grow like the square of their number. Chosen, not tuned.
const TOGETHER: usize = 2;

/// Data of a model that is being built.
pub(super) struct Builder<'a, T: Real> {
    pub(super) scene: &'a Scene<T>,
    pub(super) length: T,
    pub(super) clusters: Clusters<T>,
    pub(super) entities: Vec<Entity<T>>,
    constants: Constants,
    pub(super) bases: Vec<Basis<T>>,
    pub(super) shared: Vec<Vec<usize>>,
    pub(super) groups: Vec<GroupDraft<T>>,
    /// Measures of each number that signals use: the number is the sum of its measures.
    pub(super) measured: Vec<Vec<MeasureDraft<T>>>,
    /// Rotors, each with its entity.
    pub(super) rotors: Vec<(usize, RotorInput<T>)>,
    /// Group of each joint that has rows.
    joint_group: Vec<Option<usize>>,
}

impl<'a, T: Real> Builder<'a, T> {
    pub(super) fn new(scene: &'a Scene<T>, actions: &Actions<T>) -> Result<Self, ModelError> {
        let length = scene_length(scene);
        let clusters = Clusters::new(scene);
        let Sharing { mut entities, of_cluster: shared } = Sharing::new(scene, &clusters, length);
        let rods = ThinRods::new((scene, actions), &clusters, length);
        let mut bases = Vec::with_capacity(shared.len());
        for (c, cluster) in clusters.clusters.iter().enumerate() {
            let basis = match (scene.dimension, rods.of_cluster(cluster)) {
                _ if cluster.is_point => Basis::point_mass(cluster, &shared[c], &mut entities),
                (Dimension::Planar, _) => Basis::planar(cluster, &shared[c], &mut entities),
                (Dimension::Spatial, Some(ends)) => Basis::rod(ends, &shared[c], &mut entities),
                (Dimension::Spatial, None) => Basis::spatial(cluster, &shared[c], &mut entities)
                    .ok_or(ModelError::Basis { body: cluster.bodies[0] })?,
            };
            bases.push(basis);
        }
        Ok(Self {
            scene,
            length,
            clusters,
            constants: Constants::new(&entities),
            entities,
            bases,
            shared,
            groups: Vec::new(),
            measured: Vec::new(),
            rotors: Vec::new(),
            joint_group: alloc::vec![None; scene.joints.len()],
        })
    }

    /// Combination that gives the material point `at` of a body.
    pub(super) fn point(&mut self, body: BodyId, at: [T; 3]) -> Combination<T> {
        let at = Vector::from(at);
        match self.clusters.of(body) {
            Some(c) => self.bases[c].point(&at),
            None => self.constant(at, EntityKind::Point),
        }
    }

    /// Combination that gives the body-fixed direction `d` of a body.
    pub(super) fn direction(&mut self, body: BodyId, d: Vector<T, 3>) -> Combination<T> {
        match self.clusters.of(body) {
            Some(c) => self.bases[c].direction(&d),
            None => self.constant(d, EntityKind::Direction),
        }
    }

    fn constant(&mut self, at: Vector<T, 3>, kind: EntityKind) -> Combination<T> {
        let e = self.constants.entity(at, kind, &mut self.entities);
        alloc::vec![(e, crate::algebra::Coef::one())]
    }

    /// Adds a group for each cluster: mass, gravity, rigid-body rows, dependent points.
    pub(super) fn add_bodies(&mut self) {
        let zero = self.constant(Vector::zeros(), EntityKind::Direction)[0].0;
        let rigid = rigid_rows((&self.bases, &self.shared), &self.entities, zero);
        for (c, rows) in rigid.into_iter().enumerate() {
            let cluster = &self.clusters.clusters[c];
            let basis = &self.bases[c];
            let mut group = GroupDraft::new(Owner::Body(cluster.bodies[0]));
            group.mass = Some((basis.entities.clone(), basis.mass_matrix(cluster)));
            if let Some(g) = self.scene.gravity {
                for (mass, at) in cluster.weights(self.scene) {
                    let weight = Vector::<T, 3>::from(g) * mass;
                    for (e, coef) in basis.point(&at) {
                        group.forces.push((e, super::row_builder::lifted(coef, &weight)));
                    }
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
                let x = super::row_builder::difference(
                    &x,
                    &alloc::vec![(e, crate::algebra::Coef::one())],
                );
                if i >= TOGETHER {
                    self.groups.push(GroupDraft::new(owner));
                }
                if let Some(group) = self.groups.last_mut() {
                    group.rows.push(RowDraft::Linear { x });
                }
            }
        }
    }

    /// Group of a joint, created at the first call.
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
