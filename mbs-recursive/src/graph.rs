//! The spanning tree: which joints carry coordinates and which are cut.
//!
//! Bodies (welded ones as one) and the ground are nodes, joints are edges. The tree grows from the ground, always by the
//! joint that comes first in this order (Prim), so that it depends on the scene alone:
//!
//! 1. guided joints, since their motion is prescribed;
//! 2. revolute joints with an effect about their axis, since it acts along a coordinate;
//! 3. joints of bodies without mass, so that these end no branch where that can be avoided;
//! 4. joints with few freedoms, so that few equations are left where the others are cut;
//! 5. joints near the ground; joints named first.
//!
//! What the ground does not reach starts from a root of its own, which is free: a body with a free joint to the ground, or
//! the heaviest one. `distance` joints are always cut, free joints between moving bodies constrain nothing.

use crate::error::TreeError;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::actions::{Action, Actions};
use mbs_core::cluster::Clusters;
use mbs_core::scene::{BodyRef, JointKind, Scene};

/// A step of the tree: a cluster and the joint it hangs by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Branch {
    /// The cluster.
    pub(crate) cluster: usize,
    /// The cluster it hangs from; `None`: the ground.
    pub(crate) parent: Option<usize>,
    /// The joint; `None`: free, without a joint of the scene.
    pub(crate) joint: Option<usize>,
    /// The parent is the joint's second body.
    pub(crate) is_reversed: bool,
}

/// The spanning tree of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Graph {
    /// Parents before children.
    pub(crate) branches: Vec<Branch>,
    /// Joints that are cut, in file order.
    pub(crate) cuts: Vec<usize>,
}

/// A joint between different clusters that can carry coordinates.
struct Edge {
    joint: usize,
    /// Clusters, the ground being the last number.
    ends: [usize; 2],
    rank: (bool, bool, bool, usize),
}

/// Finds the spanning tree.
pub(crate) fn span<T: Real>(
    scene: &Scene<T>,
    actions: &Actions<T>,
    clusters: &Clusters<T>,
) -> Result<Graph, TreeError> {
    let ground = clusters.clusters.len();
    let node = |body: BodyRef| clusters.of(body).unwrap_or(ground);
    let edges = edges((scene, actions), clusters, node);
    let mut depth = vec![usize::MAX; ground + 1];
    depth[ground] = 0;
    let mut branches = Vec::new();
    let mut is_used = vec![false; scene.joints.len()];
    loop {
        grow(&edges, ground, (&mut depth, &mut is_used), &mut branches);
        // What is left starts from a free root.
        let Some((root, joint)) = root(scene, clusters, &depth, node) else { break };
        depth[root] = 1;
        let is_reversed = joint.is_some_and(|j| scene.joints[j].bodies[1] == BodyRef::Ground);
        branches.push(Branch { cluster: root, parent: None, joint, is_reversed });
    }
    let mut cuts = Vec::new();
    for (j, joint) in scene.joints.iter().enumerate() {
        let is_inner = node(joint.bodies[0]) == node(joint.bodies[1]);
        if is_used[j] {
            continue;
        }
        if scene.guides.iter().any(|guide| guide.joint == j) {
            return Err(TreeError::GuideCut { joint: j });
        }
        if is_inner || matches!(joint.kind, JointKind::Free | JointKind::Weld) {
            continue;
        }
        if let Some(effect) = effect_of(actions, j) {
            return Err(TreeError::EffectCut { effect, joint: j });
        }
        cuts.push(j);
    }
    Ok(Graph { branches, cuts })
}

fn edges<T: Real>(
    (scene, actions): (&Scene<T>, &Actions<T>),
    clusters: &Clusters<T>,
    node: impl Fn(BodyRef) -> usize,
) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (j, joint) in scene.joints.iter().enumerate() {
        let ends = joint.bodies.map(&node);
        let carries =
            !matches!(joint.kind, JointKind::Free | JointKind::Distance | JointKind::Weld);
        if ends[0] == ends[1] || !carries {
            continue;
        }
        let is_free_of_guides = scene.guides.iter().all(|guide| guide.joint != j);
        let is_massive = ends
            .iter()
            .all(|&c| clusters.clusters.get(c).is_none_or(|cluster| cluster.mass > T::ZERO));
        let rank = (
            is_free_of_guides,
            effect_of(actions, j).is_none(),
            is_massive,
            joint.kind.n_coordinates(scene.dimension),
        );
        edges.push(Edge { joint: j, ends, rank });
    }
    edges
}

/// The first effect that acts along a joint's coordinate.
fn effect_of<T: Real>(actions: &Actions<T>, joint: usize) -> Option<usize> {
    let acts = |action: &Action<T>| matches!(action, Action::Angle { joint: j, .. } if *j == joint);
    actions.list.iter().find(|(_, action)| acts(action)).map(|(effect, _)| *effect)
}

/// Adds branches until no edge leads out of the tree.
fn grow(
    edges: &[Edge],
    ground: usize,
    (depth, is_used): (&mut [usize], &mut [bool]),
    branches: &mut Vec<Branch>,
) {
    loop {
        let next = edges.iter().enumerate().filter_map(|(e, edge)| {
            let [a, b] = edge.ends.map(|c| depth[c]);
            let leads_out = (a == usize::MAX) != (b == usize::MAX);
            leads_out.then(|| (edge.rank, a.min(b), e))
        });
        let Some((_, parent_depth, e)) = next.min() else { return };
        let edge = &edges[e];
        let is_reversed = depth[edge.ends[0]] == usize::MAX;
        let [parent, child] = if is_reversed { [edge.ends[1], edge.ends[0]] } else { edge.ends };
        depth[child] = parent_depth + 1;
        is_used[edge.joint] = true;
        branches.push(Branch {
            cluster: child,
            parent: (parent != ground).then_some(parent),
            joint: Some(edge.joint),
            is_reversed,
        });
    }
}

/// The root of what the tree does not reach yet, with its free joint to the ground if it has one.
fn root<T: Real>(
    scene: &Scene<T>,
    clusters: &Clusters<T>,
    depth: &[usize],
    node: impl Fn(BodyRef) -> usize,
) -> Option<(usize, Option<usize>)> {
    let ground = clusters.clusters.len();
    for (j, joint) in scene.joints.iter().enumerate() {
        let [a, b] = joint.bodies.map(&node);
        let other = if a == ground { b } else { a };
        if joint.kind == JointKind::Free
            && (a == ground) != (b == ground)
            && depth[other] == usize::MAX
        {
            return Some((other, Some(j)));
        }
    }
    let mut best: Option<usize> = None;
    for c in (0..ground).filter(|&c| depth[c] == usize::MAX) {
        if best.is_none_or(|b| clusters.clusters[c].mass > clusters.clusters[b].mass) {
            best = Some(c);
        }
    }
    best.map(|c| (c, None))
}
