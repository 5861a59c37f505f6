//! Natural coordinates computed from the motions of the bodies, for formulations with other coordinates.

use super::basis::Basis;
use super::model::{Carried, NaturalModel};
use super::sharing::{Entity, EntityKind};
use crate::Real;
use crate::blocks::Cliques;
use crate::cluster::Clusters;
use crate::model::{Model, State, Terms};
use crate::rigid::RigidMotion;
use alloc::vec::Vec;

/// Finds a body for each unknown entity: the first body that has it.
pub(super) fn carriers<T: Real>(
    entities: &[Entity<T>],
    (clusters, bases, shared): (&Clusters<T>, &[Basis<T>], &[Vec<usize>]),
    entity_at: &[u32],
) -> Vec<Carried<T>> {
    let mut carried = Vec::new();
    let mut is_seen = alloc::vec![false; entities.len()];
    for (c, cluster) in clusters.clusters.iter().enumerate() {
        for &e in bases[c].entities.iter().chain(&shared[c]) {
            let (entity, at) = (&entities[e], entity_at[e]);
            if !(entity.is_constant || is_seen[e] || at == u32::MAX) {
                is_seen[e] = true;
                let is_point = entity.kind == EntityKind::Point;
                let body = cluster.bodies[0];
                carried.push(Carried { at, body, is_point, reference: entity.at });
            }
        }
    }
    carried
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// True if another model has the same unknowns and constraint rows as this model, in the same order. A state of one model is
    /// then a state of the other. This usually holds for a scene with and without one of its effects. Constants may differ.
    #[must_use]
    pub fn has_same_coordinates(&self, other: &Self) -> bool {
        let m = self.n_constraints();
        let sizes = |model: &Self| (model.n_unknowns(), model.n_constraints(), model.n_memory());
        sizes(self) == sizes(other)
            && self.carried == other.carried
            && (0..m).all(|row| self.owner_of_row(row) == other.owner_of_row(row))
    }

    /// Writes positions, velocities and accelerations of all unknowns from `motions`, the motion of each body of the scene.
    ///
    /// Cost: two products of a rotation and a vector and four cross products for each point or direction; no allocation.
    pub fn write_motions(&self, motions: &[RigidMotion<T>], s: &mut State<T>) {
        for entity in &self.carried {
            let Some(motion) = motions.get(entity.body) else { continue };
            let values = if entity.is_point {
                motion.point(&entity.reference)
            } else {
                motion.direction(&entity.reference)
            };
            let at = entity.at as usize;
            for (to, from) in [&mut s.q, &mut s.v, &mut s.a].into_iter().zip(values) {
                to[at..at + D].copy_from_slice(&from.as_slice()[..D]);
            }
        }
    }

    /// Writes the motions as [`write_motions`](Self::write_motions) does, and the unknowns of rotors. Measured angles are unwrapped
    /// against the angles that the state remembers. The time is that of the state.
    pub fn take_motions(&self, motions: &[RigidMotion<T>], terms: &mut Terms<T>, s: &mut State<T>) {
        self.write_motions(motions, s);
        if !s.memory.is_empty() {
            self.set_inputs(s.t, s, terms);
            self.evaluate_forces(&s.q, &s.v, terms);
            self.remember(&s.q, terms, &mut s.memory);
        }
        self.write_rotors(s);
    }

    /// Rigid clusters of the scene's bodies.
    pub(crate) fn clusters(&self) -> &Clusters<T> {
        &self.clusters
    }

    /// Typical size of every unknown: the scene's length for coordinates of points, and one for coordinates of directions. A
    /// coordinate divided by its size does not depend on the unit of length. Neither does a mass times the square of the size.
    pub(crate) fn sizes(&self) -> Vec<T> {
        let mut sizes = alloc::vec![T::ONE; self.n_unknowns()];
        for at in self.carried.iter().filter_map(Carried::point) {
            sizes[at..at + D].fill(self.length());
        }
        for at in self.rotors_on_slides() {
            sizes[at..at + D].fill(self.length());
        }
        sizes
    }
}
