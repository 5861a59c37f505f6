//! Closed loops through a joint, as a separate scene.
//!
//! Loops that have a joint in common are kept together. The loops are cycles that a spanning tree determines. Cycles with a common joint
//! are merged.

use mbs_core::Real;
use mbs_core::cluster::root;
use mbs_core::scene::{BodyId, Joint, JointKind, JointLimits, Scene};

/// Returns a scene with the joints that belong to the loops of `joint`, and with all bodies. Bodies outside the loops are welded to the
/// ground.
pub(super) fn loops_alone<T: Real>(scene: &Scene<T>, joint: usize) -> Scene<T> {
    let ground = scene.bodies.len();
    let node = |body: BodyId| body.index().unwrap_or(ground);
    let ends: Vec<[usize; 2]> = scene.joints.iter().map(|j| j.bodies.map(node)).collect();
    let is_in = together(&ends, ground + 1, joint);
    let inside = scene.joints.iter().zip(&is_in).filter(|(_, is_in)| **is_in);
    let mut joints: Vec<Joint<T>> = inside.map(|(joint, _)| joint.clone()).collect();
    let mut is_held = vec![true; ground + 1];
    for (ends, _) in ends.iter().zip(&is_in).filter(|(_, is_in)| **is_in) {
        ends.iter().for_each(|&end| is_held[end] = false);
    }
    if is_held[ground] {
        // No joint of the loops connects a body to the ground, so one body of the loops is fixed.
        is_held[ends[joint][0]] = true;
    }
    let held = scene.bodies.iter().enumerate().filter(|(b, _)| is_held[*b]);
    joints.extend(held.map(|(b, body)| Joint {
        name: String::new(),
        kind: JointKind::Weld,
        bodies: [BodyId::Ground, BodyId::Body(b)],
        points: [body.center; 2],
        axes: [None; 2],
        limits: JointLimits::NONE,
    }));
    let bodies = scene.bodies.clone();
    Scene { bodies, joints, ..Scene::empty("", scene.dimension, T::ONE) }
}

/// Returns for each edge of a graph with `n` nodes whether it belongs to the same group of cycles as `edge`.
fn together(ends: &[[usize; 2]], n: usize, edge: usize) -> Vec<bool> {
    let mut at_node = vec![Vec::new(); n];
    for (e, [a, b]) in ends.iter().enumerate() {
        at_node[*a].push(e);
        at_node[*b].push(e);
    }
    // For each node: the edge towards the root, and the distance from the root.
    let (mut up, mut depth) = (vec![None; n], vec![usize::MAX; n]);
    for first in 0..n {
        if depth[first] != usize::MAX {
            continue;
        }
        depth[first] = 0;
        let mut open = vec![first];
        while let Some(from) = open.pop() {
            for &e in &at_node[from] {
                let to = ends[e][0] + ends[e][1] - from;
                if depth[to] == usize::MAX {
                    (up[to], depth[to]) = (Some(e), depth[from] + 1);
                    open.push(to);
                }
            }
        }
    }
    let mut groups: Vec<usize> = (0..ends.len()).collect();
    for (closing, &[mut a, mut b]) in ends.iter().enumerate() {
        while a != b {
            if depth[a] < depth[b] {
                (a, b) = (b, a);
            }
            let Some(e) = up[a] else { break };
            let [one, other] = [closing, e].map(|edge| root(&mut groups, edge));
            groups[other] = one;
            a = ends[e][0] + ends[e][1] - a;
        }
    }
    let own = root(&mut groups, edge);
    (0..ends.len()).map(|e| root(&mut groups, e) == own).collect()
}
