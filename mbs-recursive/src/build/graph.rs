//! The spanning tree: selection of the joints that carry coordinates, and of the joints that are cut.
//!
//! The ground and the bodies are nodes; welded bodies are one node. Joints are edges. The tree grows from the ground by Prim's algorithm.
//! It depends on the scene alone, because the next joint is always the first in this order:
//!
//! 1. guided joints, since their motion is prescribed;
//! 2. joints whose coordinates are needed: revolute joints with an effect about their axis, joints with a rotor, joints of couplings and of
//!    effects on sums, and joints that signals measure. A free joint whose coordinates are needed has one link for each coordinate;
//! 3. joints of bodies without mass, so that these bodies are at the end of a branch only where this is unavoidable;
//! 4. joints with few freedoms, so that the cut joints have few equations;
//! 5. balls off the line of a thin rod, because the rod has inertia about such a point in every direction;
//! 6. joints near the ground, then joints that come first in the file.
//!
//! A part of the mechanism that no joint connects to the ground starts from a free root. The root is a body with a free joint to the
//! ground. If the part has no such body, the root is its heaviest body. Joints of kind link are always cut. Other free joints between
//! moving bodies are no constraints.

use crate::build::error::TreeError;
use alloc::collections::BinaryHeap;
use alloc::vec;
use alloc::vec::Vec;
use core::cmp::{Ordering, Reverse};
use mbs_core::Real;
use mbs_core::actions::{Action, Actions};
use mbs_core::cluster::{Clusters, is_on_line};
use mbs_core::measure::{RotorInput, TermInput};
use mbs_core::scene::{BallAngle, BodyId, CouplingMeasure, Freedom, Scene, SignalKind};

/// Branch of the tree: a cluster (bodies welded together) with the joint that carries it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Branch {
    /// Index of the cluster.
    pub(crate) cluster: usize,
    /// Index of the parent cluster; `None` for the ground.
    pub(crate) parent: Option<usize>,
    /// Index of the joint; `None` for a free cluster without a joint in the scene.
    pub(crate) joint: Option<usize>,
    /// True if the parent is the joint's second body.
    pub(crate) is_reversed: bool,
    /// True if the cluster is a point mass, which has no rotation.
    pub(crate) is_point: bool,
    /// True if a free joint has one link for each slide and one link for its rotation. This is so if one of its coordinates is needed.
    pub(crate) is_apart: bool,
}

/// The spanning tree of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Graph {
    /// Branches of the tree, parents before children.
    pub(crate) branches: Vec<Branch>,
    /// Joints that are cut, in file order.
    pub(crate) cuts: Vec<usize>,
}

/// A joint between different clusters that can carry coordinates.
struct Edge {
    joint: usize,
    /// Indices of the clusters at both ends; the ground has the largest index.
    ends: [usize; 2],
    rank: Rank,
}

/// Rank of a joint by the first five criteria of the order. A lower rank comes first.
type Rank = (bool, bool, bool, usize, bool);

/// Finds the spanning tree.
///
/// Cost: of order n log n, where n is the number of joints and bodies.
pub(crate) fn span<T: Real>(
    scene: &Scene<T>,
    actions: &Actions<T>,
    clusters: &Clusters<T>,
) -> Result<Graph, TreeError> {
    let ground = clusters.clusters.len();
    let node = |body: BodyId| clusters.of(body).unwrap_or(ground);
    let demands = Demands::new(scene, actions);
    let mut growth = Growth::new(edges((scene, &demands), clusters, node), ground);
    let mut roots = Roots::new(scene, clusters);
    let mut is_used = vec![false; scene.joints.len()];
    growth.depth[ground] = 0;
    growth.reach(ground);
    loop {
        growth.grow(&mut is_used);
        // A part that is not connected to the ground starts from a free root.
        let Some((root, joint)) = roots.next(scene, &growth.depth, node) else { break };
        let is_reversed = joint.is_some_and(|j| node(scene.joints[j].bodies[1]) == ground);
        let is_point = clusters.clusters[root].is_point;
        growth.branches.push(Branch {
            cluster: root,
            parent: None,
            joint,
            is_reversed,
            is_point,
            is_apart: false,
        });
        growth.depth[root] = 1;
        growth.reach(root);
    }
    let mut cuts = Vec::new();
    for (j, joint) in scene.joints.iter().enumerate() {
        let is_inner = node(joint.bodies[0]) == node(joint.bodies[1]);
        if is_used[j] {
            continue;
        }
        if demands.is_guided[j] {
            return Err(TreeError::GuideCut { joint: j });
        }
        if is_inner || joint.kind.is_free() || joint.kind.is_rigid() {
            continue;
        }
        if demands.is_measured[j] {
            return Err(TreeError::Signal { joint: j });
        }
        if let Some(coupling) = demands.coupling[j] {
            return Err(TreeError::Coupling { coupling });
        }
        if let Some(effect) = demands.effect[j] {
            return Err(TreeError::EffectCut { effect, joint: j });
        }
        cuts.push(j);
    }
    Ok(Graph { branches: growth.branches, cuts })
}

/// Guides, effects, couplings and signals that need the coordinates of each joint.
struct Demands {
    is_guided: Vec<bool>,
    /// First effect that acts along the joint, if any.
    effect: Vec<Option<usize>>,
    /// First coupling that has a coordinate of the joint, if any.
    coupling: Vec<Option<usize>>,
    /// True if a signal measures a coordinate of the joint.
    is_measured: Vec<bool>,
    /// True if a coordinate of the joint is a term of a sum or is measured. Angles between bodies are known without such a coordinate.
    is_apart: Vec<bool>,
}

impl Demands {
    fn new<T: Real>(scene: &Scene<T>, actions: &Actions<T>) -> Self {
        let n = scene.joints.len();
        let (effect, coupling) = (vec![None; n], vec![None; n]);
        let [is_measured, is_apart] = [vec![false; n], vec![false; n]];
        let mut new = Self { is_guided: vec![false; n], effect, coupling, is_measured, is_apart };
        for guide in &scene.guides {
            new.is_guided[guide.joint.index()] = true;
        }
        for (i, coupling) in scene.couplings.iter().enumerate() {
            let terms = coupling.terms.iter().filter(|term| !term.factor.is_zero());
            for (joint, _) in terms.filter_map(|term| term.of.coordinate()) {
                new.coupling[joint.index()].get_or_insert(i);
                new.is_apart[joint.index()] = true;
            }
        }
        for signal in &scene.signals {
            // a length or the swing of a ball is known even if the joint is cut
            if let SignalKind::Measure { of: CouplingMeasure::Coordinate { joint, .. }, .. } =
                signal.kind
            {
                new.is_measured[joint.index()] = true;
                new.is_apart[joint.index()] = true;
            }
        }
        for rotor in RotorInput::all(scene) {
            new.effect[rotor.joint].get_or_insert(rotor.effect);
        }
        for (effect, action) in &actions.list {
            match action {
                Action::Angle { joint, .. } => {
                    new.effect[*joint].get_or_insert(*effect);
                }
                Action::Sum { terms, .. } => {
                    for joint in terms.iter().filter_map(carried_joint) {
                        new.effect[joint].get_or_insert(*effect);
                    }
                    for (joint, _) in terms.iter().filter_map(|term| term.coordinate) {
                        new.is_apart[joint] = true;
                    }
                }
                _ => {}
            }
        }
        new
    }
}

/// Returns the joint whose coordinates a term needs, if any. The swing of a ball needs no coordinate.
fn carried_joint<T: Real>(term: &TermInput<T>) -> Option<usize> {
    match term.of {
        CouplingMeasure::Ball { joint, angle: BallAngle::Twist, .. } => Some(joint.index()),
        _ => term.coordinate.map(|(joint, _)| joint),
    }
}

fn edges<T: Real>(
    (scene, demands): (&Scene<T>, &Demands),
    clusters: &Clusters<T>,
    node: impl Fn(BodyId) -> usize,
) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (j, joint) in scene.joints.iter().enumerate() {
        let ends = joint.bodies.map(&node);
        let n_coordinates = joint.kind.n_coordinates(scene.dimension);
        let is_whole = !demands.is_apart[j] || joint.kind.is_of_point();
        let is_loose = joint.kind.is_free() && !demands.is_guided[j] && is_whole;
        if ends[0] == ends[1] || n_coordinates == 0 || is_loose {
            continue;
        }
        let is_massive = ends
            .iter()
            .all(|&c| clusters.clusters.get(c).is_none_or(|cluster| cluster.mass > T::ZERO));
        let is_on_line = joint.freedoms(scene.dimension).contains(&Freedom::Ball)
            && (0..2).any(|i| {
                let rod = clusters.clusters.get(ends[i]).and_then(|cluster| cluster.rod);
                rod.is_some_and(|rod| is_on_line(&rod, joint.points[i]))
            });
        let rank = (
            !demands.is_guided[j],
            demands.effect[j].is_none() && demands.coupling[j].is_none() && !demands.is_measured[j],
            is_massive,
            n_coordinates,
            is_on_line,
        );
        edges.push(Edge { joint: j, ends, rank });
    }
    edges
}

/// State of the tree while it grows.
struct Growth {
    edges: Vec<Edge>,
    /// Indices of the edges at each node.
    at_node: Vec<Vec<usize>>,
    ground: usize,
    depth: Vec<usize>,
    /// Edges that lead out of the tree. They are sorted by rank, then by depth in the tree, then by index.
    open: BinaryHeap<Reverse<(Rank, usize, usize)>>,
    branches: Vec<Branch>,
}

impl Growth {
    fn new(edges: Vec<Edge>, ground: usize) -> Self {
        let mut at_node = vec![Vec::new(); ground + 1];
        for (e, edge) in edges.iter().enumerate() {
            edge.ends.into_iter().for_each(|end| at_node[end].push(e));
        }
        let depth = vec![usize::MAX; ground + 1];
        Self { edges, at_node, ground, depth, open: BinaryHeap::new(), branches: Vec::new() }
    }

    /// Takes a new node of the tree, and adds its edges that lead out of the tree to the open edges.
    fn reach(&mut self, node: usize) {
        for &e in &self.at_node[node] {
            let [a, b] = self.edges[e].ends;
            if self.depth[a] == usize::MAX || self.depth[b] == usize::MAX {
                self.open.push(Reverse((self.edges[e].rank, self.depth[node], e)));
            }
        }
    }

    /// Adds branches until no edge leads out of the tree.
    fn grow(&mut self, is_used: &mut [bool]) {
        while let Some(Reverse((_, parent_depth, e))) = self.open.pop() {
            let Edge { joint, ends, .. } = self.edges[e];
            let is_reversed = self.depth[ends[0]] == usize::MAX;
            let [parent, child] = if is_reversed { [ends[1], ends[0]] } else { ends };
            if self.depth[child] != usize::MAX {
                continue;
            }
            self.depth[child] = parent_depth + 1;
            is_used[joint] = true;
            self.branches.push(Branch {
                cluster: child,
                parent: (parent != self.ground).then_some(parent),
                joint: Some(joint),
                is_reversed,
                // A cluster that a joint carries can turn, so it is no point mass. A point mass at a ball joint belongs to the body of the
                // ball joint.
                is_point: false,
                is_apart: true,
            });
            self.reach(child);
        }
    }
}

/// Candidates for the roots of parts that are not connected to the ground, best first.
struct Roots {
    /// Free joints, in the order of the file.
    free: vec::IntoIter<usize>,
    /// Clusters, the heaviest first. Clusters of equal mass are in the order of their indices.
    heavy: vec::IntoIter<usize>,
}

impl Roots {
    fn new<T: Real>(scene: &Scene<T>, clusters: &Clusters<T>) -> Self {
        // a point mass that belongs to a rigid body is not a root
        let is_whole =
            |body: BodyId| clusters.of(body).is_some_and(|c| clusters.clusters[c].is_point);
        let is_free = |j: &usize| {
            let joint = &scene.joints[*j];
            joint.kind.is_free() && (!joint.kind.is_of_point() || is_whole(joint.bodies[1]))
        };
        let free: Vec<usize> = (0..scene.joints.len()).filter(is_free).collect();
        let mass = |c: usize| clusters.clusters[c].mass;
        let mut heavy: Vec<usize> = (0..clusters.clusters.len()).collect();
        heavy.sort_by(|&a, &b| mass(b).partial_cmp(&mass(a)).unwrap_or(Ordering::Equal));
        Self { free: free.into_iter(), heavy: heavy.into_iter() }
    }

    /// Returns the next root outside the tree, with its free joint to the ground if there is one.
    fn next<T: Real>(
        &mut self,
        scene: &Scene<T>,
        depth: &[usize],
        node: impl Fn(BodyId) -> usize,
    ) -> Option<(usize, Option<usize>)> {
        let ground = depth.len() - 1;
        // Clusters of the tree remain in it, so each candidate is checked once.
        let with_joint = self.free.find_map(|j| {
            let [a, b] = scene.joints[j].bodies.map(&node);
            let other = if a == ground { b } else { a };
            let is_root = (a == ground) != (b == ground) && depth[other] == usize::MAX;
            is_root.then_some((other, Some(j)))
        });
        with_joint.or_else(|| self.heavy.find(|&c| depth[c] == usize::MAX).map(|root| (root, None)))
    }
}
