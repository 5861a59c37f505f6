//! Closed loops of a mechanism, the branch in which each is assembled, and its distance to another branch.
//!
//! ```text
//! three successive places A, B, C of a loop, a the axis at B, x̄ the part of x across a:
//! turn = atan2(a·(AB × BC), AB̄·BC̄)      its sign is the branch, min(|turn|, π − |turn|) the distance to a straight line
//! ```
//!
//! The two branches of a triangle meet where its three points are in a straight line. A part with one freedom has a single motion u with J
//! u = 0. The drive ratio of a joint is its rate in this motion relative to that of the fastest joint. If a part is driven at a joint with
//! a drive ratio of zero, it is at a dead point. There it can change from one branch to the other.

use super::Vector;
use super::link::{Poses, pose};
use super::linkage::Linkage;
use super::parts::Part;
use super::rank::Rank;
use mbs_core::algebra::cross;
use mbs_core::scene::{BodyId, Dimension, Freedom, Rotation, Translation};
use std::collections::VecDeque;

/// A corner of a closed loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Index of the joint at the corner.
    pub joint: usize,
    /// Signed angle of the corner about the joint's axis [rad]; not signed at a joint without an axis.
    pub turn: f64,
    /// True if a motion preserves the sign of the angle.
    pub has_sign: bool,
}

impl Corner {
    /// Returns the smallest change of the angle that puts the three points in a straight line [rad].
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.turn.abs().min(core::f64::consts::PI - self.turn.abs())
    }
}

/// Closed loop of joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// Joints of the loop in their cyclic order, beginning with the first in the scene.
    pub joints: Vec<usize>,
    /// Corners at revolute, spherical and universal joints, where three points form a triangle.
    pub corners: Vec<Corner>,
}

/// Returns the shortest independent loops of a linkage at a pose. A spanning tree is built breadth first from the ground, and each joint
/// that is not in the tree closes one loop. Cost: for each loop, proportional to the number of bodies of its part.
#[must_use]
pub fn loops(linkage: &Linkage, at: &Poses) -> Vec<Loop> {
    let parts = linkage.parts.iter().filter(|part| part.has_loop());
    let joints = parts.flat_map(|part| cycles(linkage, part));
    joints.map(|joints| Loop { corners: corners(linkage, at, &joints), joints }).collect()
}

/// Returns the loops of a part, each as a list of joints in cyclic order.
fn cycles(linkage: &Linkage, part: &Part) -> Vec<Vec<usize>> {
    let node = |body: BodyId| match body {
        BodyId::Ground => part.bodies.len(),
        BodyId::Body(b) => part.bodies.binary_search(&b).unwrap_or(part.bodies.len()),
    };
    let ends = |j: usize| linkage.links[j].joint.bodies.map(node);
    let n = part.bodies.len() + 1;
    let mut at_node = vec![Vec::new(); n];
    for &j in &part.joints {
        ends(j).into_iter().for_each(|end| at_node[end].push(j));
    }
    let root = if at_node[n - 1].is_empty() { 0 } else { n - 1 };
    let mut by = vec![None; n];
    let mut is_reached = vec![false; n];
    let mut queue = VecDeque::from([root]);
    is_reached[root] = true;
    while let Some(node) = queue.pop_front() {
        for &j in &at_node[node] {
            let [a, b] = ends(j);
            let other = if a == node { b } else { a };
            if !is_reached[other] {
                is_reached[other] = true;
                by[other] = Some((j, node));
                queue.push_back(other);
            }
        }
    }
    let up = |mut node: usize| {
        let mut way = Vec::new();
        while let Some((j, parent)) = by[node] {
            way.push(j);
            node = parent;
        }
        way
    };
    let in_tree = |j: usize| by.iter().flatten().any(|(tree, _)| *tree == j);
    let close = |&j: &usize| {
        let [mut first, mut second] = ends(j).map(up);
        while first.last().is_some() && first.last() == second.last() {
            first.pop();
            second.pop();
        }
        // The loop runs from the closing joint up one branch of the tree and down the other branch.
        let mut round: Vec<usize> =
            [j].into_iter().chain(second).chain(first.into_iter().rev()).collect();
        let least = (0..round.len()).min_by_key(|&i| round[i]).unwrap_or(0);
        round.rotate_left(least);
        round
    };
    part.joints.iter().filter(|&&j| !in_tree(j)).map(close).collect()
}

/// Returns the corners at joints with a fixed point. Sliding joints have no corner, because their point along the axis is arbitrary.
fn corners(linkage: &Linkage, at: &Poses, joints: &[usize]) -> Vec<Corner> {
    let mut stations: Vec<(usize, Vector)> = Vec::new();
    let n = joints.len();
    for (i, &j) in joints.iter().enumerate() {
        let link = &linkage.links[j];
        let kind = link.joint.kind;
        if kind.is_link() {
            // Both points of a link. The first is on the body that the link shares with the joint before.
            let before = linkage.links[joints[(i + n - 1) % n]].joint.bodies;
            let is_forward = before.contains(&link.joint.bodies[0]);
            let ends = if is_forward { [0, 1] } else { [1, 0] };
            stations.extend(ends.map(|end| (j, link.place(at, end))));
        } else if kind.translation(linkage.dimension) == Translation::Fixed {
            stations.push((j, link.place(at, 1)));
        }
    }
    let m = stations.len();
    if m < 3 {
        return Vec::new();
    }
    let corner = |i: usize| {
        let (joint, here) = stations[i];
        let (to, from) = (here - stations[(i + m - 1) % m].1, stations[(i + 1) % m].1 - here);
        turn(linkage, at, joint, [to, from])
    };
    (0..m).filter_map(corner).collect()
}

/// Distance of two points that counts as zero, relative to the sum of two neighbouring distances [-]. The direction between such points is
/// undefined. Chosen, not tuned.
const NO_LENGTH: f64 = 1e-9;

fn turn(linkage: &Linkage, at: &Poses, joint: usize, [to, from]: [Vector; 2]) -> Option<Corner> {
    let link = &linkage.links[joint].joint;
    let axis = match (linkage.dimension, link.kind.rotation(linkage.dimension)) {
        (Dimension::Planar, _) => Some(Vector::new(0.0, 0.0, 1.0)),
        (Dimension::Spatial, Rotation::About(axis)) => {
            Some(pose(at, link.bodies[0]).rotation * link.direction(axis))
        }
        (Dimension::Spatial, Rotation::Fixed | Rotation::Universal(_) | Rotation::Free) => None,
    };
    let across = |x: Vector| axis.map_or(x, |a| x - a * a.dot(&x));
    let [to, from] = [across(to), across(from)];
    let least = NO_LENGTH * (to.norm() + from.norm());
    if to.norm() <= least || from.norm() <= least {
        return None;
    }
    let normal = cross(&to, &from);
    let sine = axis.map_or(normal.norm(), |a| a.dot(&normal));
    Some(Corner { joint, turn: sine.atan2(to.dot(&from)), has_sign: axis.is_some() })
}

/// Rate of a joint in the motion of its part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    /// Index of the joint.
    pub joint: usize,
    /// Ratio of the joint's rate to that of the fastest joint of the part, with the sign in the common motion [-]. Rates of angles are
    /// multiplied by the part's length.
    pub share: f64,
}

/// Returns the rates of the joints of a part at a pose, if the part has one freedom. Returns an empty list otherwise.
#[must_use]
pub fn drives(linkage: &Linkage, part: &Part, at: &Poses, rank: &Rank) -> Vec<Drive> {
    if rank.free.n_columns() != 1 {
        return Vec::new();
    }
    let f = linkage.freedoms();
    let twist = |body: BodyId| {
        let i = if let BodyId::Body(b) = body { part.bodies.binary_search(&b).ok() } else { None };
        let x: Vec<f64> =
            i.map_or(vec![0.0; f], |i| (0..f).map(|k| rank.free[(i * f + k, 0)]).collect());
        match linkage.dimension {
            Dimension::Planar => [Vector::new(x[0], x[1], 0.0), Vector::new(0.0, 0.0, x[2])],
            Dimension::Spatial => [Vector::new(x[0], x[1], x[2]), Vector::new(x[3], x[4], x[5])],
        }
    };
    let rate = |&j: &usize| {
        let link = &linkage.links[j];
        let place = link.place(at, 1);
        let [first, second] = link.joint.bodies.map(|body| {
            let [v, turn] = twist(body);
            let center = pose(at, body).position;
            [v + cross(&turn, &(place - center)) / part.length, turn]
        });
        let [slide, turn] = [second[0] - first[0], second[1] - first[1]];
        let along = |axis| pose(at, link.joint.bodies[0]).rotation * link.joint.direction(axis);
        match link.joint.kind.single(linkage.dimension) {
            Some(Freedom::Slide(axis)) => along(axis).dot(&slide),
            Some(Freedom::Turn(axis)) => along(axis).dot(&turn),
            Some(Freedom::Ball) | None => (slide.norm_squared() + turn.norm_squared()).sqrt(),
        }
    };
    let rates: Vec<f64> = part.joints.iter().map(rate).collect();
    let largest = rates.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
    let drive = |(&joint, rate): (&usize, &f64)| Drive { joint, share: rate / largest };
    part.joints.iter().zip(&rates).map(drive).collect()
}
