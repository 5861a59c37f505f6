//! Points and directions that bodies share, found by union-find over (body, point) and (body, direction) in file order.
//!
//! The rule: a joint names the point or direction that its two bodies have in common. Two points of one body are the same feature
//! if they are at the same place. Two directions are the same if they are parallel, with either sign. The
//! [`TOLERANCE`](crate::cluster::TOLERANCE) is relative to the scene's length. Features that a chain of joints connects are one
//! *entity*. An entity that includes a ground feature is a constant.

use super::spatial_index::SpatialIndex;
use crate::Real;
use crate::algebra::{Vector, cross, norm};
use crate::cluster::{Clusters, point_tolerance, root};
use crate::joint::{Dimension, Translation};
use crate::mechanism::Scene;
use crate::scene::Joint;
use alloc::collections::BTreeSet;
use alloc::vec::Vec;

/// Kind of an entity: a point or a direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EntityKind {
    Point,
    Direction,
}

/// Natural coordinate vector: a point or a unit direction of one or more bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Entity<T: Real> {
    pub(crate) kind: EntityKind,
    /// Value in the reference configuration.
    pub(crate) at: Vector<T, 3>,
    /// True if the entity is fixed to the ground.
    pub(crate) is_constant: bool,
}

#[derive(Debug)]
struct Feature<T: Real> {
    owner: Option<usize>,
    kind: EntityKind,
    at: Vector<T, 3>,
}

/// Shared entities, and the clusters that have them.
#[derive(Debug)]
pub(crate) struct Sharing<T: Real> {
    /// Entities that bodies share.
    pub(crate) entities: Vec<Entity<T>>,
    /// Entities that each cluster shares, in file order.
    pub(crate) of_cluster: Vec<Vec<usize>>,
}

impl<T: Real> Sharing<T> {
    /// Finds the points and directions that the joints of a scene make common.
    pub(crate) fn new(scene: &Scene<T>, clusters: &Clusters<T>, length: T) -> Self {
        let mut table = Table {
            features: Vec::new(),
            parent: Vec::new(),
            by_owner: Vec::new(),
            tolerance: length * point_tolerance::<T>(),
        };
        table.by_owner.resize_with(clusters.clusters.len() + 1, || {
            [SpatialIndex::new(table.tolerance), SpatialIndex::new(point_tolerance::<T>())]
        });
        for joint in &scene.joints {
            let owners = joint.bodies.map(|b| clusters.of(b));
            if owners[0] != owners[1] {
                for (kind, at) in common(joint, scene.dimension) {
                    table.share(owners, kind, at);
                }
            }
        }
        table.collect(clusters.clusters.len())
    }
}

/// Point and direction that the bodies of a joint have in common, if the joint has them.
fn common<T: Real>(
    joint: &Joint<T>,
    dimension: Dimension,
) -> impl Iterator<Item = (EntityKind, Vector<T, 3>)> {
    let has_point = joint.kind.translation(dimension) == Translation::Fixed;
    let point = has_point.then(|| (EntityKind::Point, Vector::from(joint.points[0])));
    let axis = joint.common_axis(dimension).map(|axis| (EntityKind::Direction, axis));
    point.into_iter().chain(axis)
}

struct Table<T: Real> {
    features: Vec<Feature<T>>,
    /// Parent of each feature in the union-find forest; the root of a class is its own parent.
    parent: Vec<usize>,
    /// Points and directions of each cluster; the ground is last.
    by_owner: Vec<[SpatialIndex; 2]>,
    tolerance: T,
}

impl<T: Real> Table<T> {
    fn share(&mut self, owners: [Option<usize>; 2], kind: EntityKind, at: Vector<T, 3>) {
        let [a, b] = owners.map(|owner| self.feature(owner, kind, at));
        let (a, b) = (root(&mut self.parent, a), root(&mut self.parent, b));
        let (keep, drop) = if a < b { (a, b) } else { (b, a) };
        self.parent[drop] = keep;
    }

    fn feature(&mut self, owner: Option<usize>, kind: EntityKind, at: Vector<T, 3>) -> usize {
        let list = owner.unwrap_or(self.by_owner.len() - 1);
        let (features, tolerance) = (&self.features, self.tolerance);
        let [points, directions] = &mut self.by_owner[list];
        let place = |f: usize| features[f].at;
        let (near, found) = match kind {
            EntityKind::Point => {
                let same = |f: usize| norm(&(features[f].at - at)) <= tolerance;
                let found = points.first(&[at], same, place);
                (points, found)
            }
            EntityKind::Direction => {
                let same =
                    |f: usize| norm(&cross(&features[f].at, &at)) <= self::point_tolerance::<T>();
                let found = directions.first(&[at, -at], same, place);
                (directions, found)
            }
        };
        found.unwrap_or_else(|| {
            let index = self.features.len();
            near.push(index, &at);
            self.features.push(Feature { owner, kind, at });
            self.parent.push(index);
            index
        })
    }

    /// Makes an entity of each class of features. If the ground has a feature of the class, the entity has the ground's value.
    fn collect(mut self, n_clusters: usize) -> Sharing<T> {
        let mut entities: Vec<Entity<T>> = Vec::new();
        let mut of_root = alloc::vec![usize::MAX; self.features.len()];
        let mut of_cluster = alloc::vec![Vec::new(); n_clusters];
        let mut seen = BTreeSet::new();
        for i in 0..self.features.len() {
            let (root, f) = (root(&mut self.parent, i), &self.features[i]);
            if of_root[root] == usize::MAX {
                of_root[root] = entities.len();
                entities.push(Entity { kind: f.kind, at: f.at, is_constant: false });
            }
            let e = of_root[root];
            match f.owner {
                None => {
                    entities[e].is_constant = true;
                    entities[e].at = f.at;
                }
                Some(c) if seen.insert((c, e)) => of_cluster[c].push(e),
                Some(_) => {}
            }
        }
        Sharing { entities, of_cluster }
    }
}
