//! Placement of open trees joint by joint, without solving equations.

use crate::Real;
use crate::algebra::{Matrix, Vector, rotation};
use crate::cluster::Clusters;
use crate::joint::{Dimension, Freedom};
use crate::mechanism::{Scene, given_values};
use crate::rigid::RigidMotion;
use crate::scene::{BodyId, Joint};
use alloc::vec;
use alloc::vec::Vec;

/// Joint with the coordinates by which a body is placed.
#[derive(Debug)]
struct Branch<T> {
    joint: usize,
    values: Vec<T>,
    /// True if the joint places the second body; false if it places the first.
    is_forward: bool,
}

/// Open tree of joints, from its roots outwards.
#[derive(Debug)]
pub(super) struct Placement<'a, T: Real> {
    scene: &'a Scene<T>,
    clusters: &'a Clusters<T>,
    branches: Vec<Branch<T>>,
    /// True if every joint has given values, and every tree has a root on the ground.
    pub(super) is_complete: bool,
}

impl<'a, T: Real> Placement<'a, T> {
    /// Tree of a scene with given values: initial values, guides, and values that follow from couplings. `None` if joints close loops.
    pub(super) fn new(scene: &'a Scene<T>, clusters: &'a Clusters<T>) -> Option<Self> {
        let ground = clusters.clusters.len();
        let node = |body: BodyId| clusters.of(body).unwrap_or(ground);
        // a joint of a point mass within a cluster is as rigid as a weld
        let is_inside = |j: &Joint<T>| {
            let [first, second] = j.bodies.map(node);
            j.kind.is_rigid() || first == second && scene.turns_point(j)
        };
        let joints = || scene.joints.iter().enumerate().filter(|(_, j)| !is_inside(j));
        let mut touching = vec![Vec::new(); ground + 1];
        for (j, joint) in joints() {
            joint.bodies.into_iter().for_each(|body| touching[node(body)].push(j));
        }
        let mut given: Vec<Option<Vec<T>>> =
            given_values(scene).into_iter().map(|values| values.into_iter().collect()).collect();
        let mut is_placed = vec![false; ground + 1];
        let (mut branches, mut is_complete) = (Vec::new(), true);
        for root in core::iter::once(ground).chain(0..ground) {
            if is_placed[root] {
                continue;
            }
            is_placed[root] = true;
            is_complete &= root == ground;
            let mut waiting = vec![root];
            while let Some(parent) = waiting.pop() {
                for &j in &touching[parent] {
                    let joint = &scene.joints[j];
                    let [first, second] = joint.bodies.map(node);
                    let child = if first == parent { second } else { first };
                    if is_placed[child] {
                        continue;
                    }
                    is_placed[child] = true;
                    let values = given[j].take();
                    is_complete &= values.is_some();
                    let values = values.unwrap_or_else(|| at_reference(joint, scene.dimension));
                    branches.push(Branch { joint: j, values, is_forward: first == parent });
                    waiting.push(child);
                }
            }
        }
        let is_tree = branches.len() == joints().count();
        let is_known = branches.iter().all(|b| !scene.joints[b.joint].kind.is_link());
        (is_tree && is_known).then_some(Self { scene, clusters, branches, is_complete })
    }

    /// Positions of the bodies, with all joint coordinates at the fraction `tau` of their given values. Velocities are zero.
    pub(super) fn motions(&self, tau: T) -> Vec<RigidMotion<T>> {
        let origin = Vector::<T, 3>::zeros();
        let mut motions = vec![RigidMotion::at_rest(origin); self.clusters.clusters.len()];
        for branch in &self.branches {
            let joint = &self.scene.joints[branch.joint];
            let values: Vec<T> = branch.values.iter().map(|&x| x * tau).collect();
            let (turn, place) = relative(joint, self.scene.dimension, &values);
            let [first, second] = joint.bodies.map(|body| self.clusters.of(body));
            let end = Vector::from(joint.points[1]);
            let (parent, child) = if branch.is_forward { (first, second) } else { (second, first) };
            let parent = parent.map_or(RigidMotion::at_rest(origin), |parent| motions[parent]);
            // A point x of the second body has the position turn (x - end) + place in the first body's reference frame.
            let (from, to, turn) =
                if branch.is_forward { (place, end, turn) } else { (end, place, turn.transpose()) };
            if let Some(child) = child {
                motions[child] = RigidMotion {
                    position: parent.point(&from)[0],
                    rotation: parent.rotation * turn,
                    ..RigidMotion::at_rest(to)
                };
            }
        }
        let of_body = self.clusters.of_body.iter();
        of_body.map(|c| c.map_or(RigidMotion::at_rest(origin), |c| motions[c])).collect()
    }
}

/// Coordinates of a joint in the reference configuration.
fn at_reference<T: Real>(joint: &Joint<T>, dimension: Dimension) -> Vec<T> {
    vec![T::ZERO; joint.kind.n_coordinates(dimension)]
}

/// Rotation of the second body in axes of the first, and position of the second body's joint point in the first body's reference frame.
fn relative<T: Real>(
    joint: &Joint<T>,
    dimension: Dimension,
    values: &[T],
) -> (Matrix<T, 3>, Vector<T, 3>) {
    let mut place = Vector::<T, 3>::from(joint.points[0]);
    let mut turn = None;
    for (number, freedom) in joint.kind.numbered(dimension) {
        let value = |i: usize| values.get(number + i).copied().unwrap_or(T::ZERO);
        let by = match freedom {
            Freedom::Slide(axis) => {
                place += joint.direction(axis) * value(0);
                continue;
            }
            Freedom::Turn(axis) => rotation(&(joint.direction(axis) * value(0))),
            Freedom::Ball => rotation(&Vector::<T, 3>::new(value(0), value(1), value(2))),
        };
        turn = Some(turn.map_or(by, |turn: Matrix<T, 3>| turn * by));
    }
    (turn.unwrap_or_else(Matrix::<T, 3>::identity), place)
}
