//! Parts of a mechanism without a common loop. Rows of different parts never depend on each other.
//!
//! The graph has a node for each body and one for the ground, and an edge for each joint that has rows. Its biconnected components
//! (Hopcroft and Tarjan 1973) are the parts. Joints that can transmit internal forces while all bodies are at rest form loops. Every loop
//! is within one component. A part with one joint is a bridge of the graph and never has dependent rows.

use super::link::{Link, Poses, pose};
use mbs_core::algebra::norm;
use mbs_core::scene::BodyId;

/// Joints that may depend on each other, with the bodies between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Indices of the joints, in ascending order.
    pub joints: Vec<usize>,
    /// Indices of the bodies, in ascending order, without the ground.
    pub bodies: Vec<usize>,
    /// Length of the part [m]: the largest distance of a joint's point from the centre of one of its bodies; one if all distances are zero.
    pub length: f64,
}

impl Part {
    /// True if the part contains a loop. A part without a loop is a single joint.
    #[must_use]
    pub fn has_loop(&self) -> bool {
        self.joints.len() > 1
    }
}

/// Returns the parts of `n` bodies and their links. Cost: proportional to the number of bodies and joints.
pub(crate) fn parts(n: usize, links: &[Link], at: &Poses) -> Vec<Part> {
    let node = |body: BodyId| match body {
        BodyId::Ground => n,
        BodyId::Body(b) => b,
    };
    let mut edges = vec![Vec::new(); n + 1];
    let rigid = links.iter().enumerate().filter(|(_, link)| link.n_rows() > 0);
    for (j, link) in rigid {
        let [a, b] = link.joint.bodies.map(node);
        edges[a].push((b, j));
        edges[b].push((a, j));
    }
    let mut search = Search {
        edges,
        depth: vec![usize::MAX; n + 1],
        low: vec![0; n + 1],
        stack: Vec::new(),
        found: Vec::new(),
    };
    for root in (0..=n).rev() {
        if search.depth[root] == usize::MAX {
            search.from(root);
        }
    }
    search.found.sort_unstable();
    search.found.into_iter().map(|joints| part(links, joints, at)).collect()
}

fn part(links: &[Link], joints: Vec<usize>, at: &Poses) -> Part {
    let links = || joints.iter().map(|&j| &links[j]);
    let mut bodies: Vec<usize> = links()
        .flat_map(|link| link.joint.bodies)
        .filter_map(|body| if let BodyId::Body(b) = body { Some(b) } else { None })
        .collect();
    bodies.sort_unstable();
    bodies.dedup();
    let mut length = 0.0_f64;
    for link in links() {
        for (i, body) in link.joint.bodies.into_iter().enumerate() {
            if body != BodyId::Ground {
                length = length.max(norm(&(link.place(at, i) - pose(at, body).position)));
            }
        }
    }
    let length = if length > 0.0 { length } else { 1.0 };
    Part { joints, bodies, length }
}

struct Search {
    /// Edges of each node, as pairs of neighbour and joint.
    edges: Vec<Vec<(usize, usize)>>,
    depth: Vec<usize>,
    /// Smallest depth that one back edge reaches from the subtree of a node.
    low: Vec<usize>,
    stack: Vec<usize>,
    found: Vec<Vec<usize>>,
}

/// A node on the current path: its number, the edge that led to it, the number of edges followed, and the edges stacked before it.
struct Visit {
    node: usize,
    by: Option<usize>,
    next: usize,
    below: usize,
}

impl Search {
    /// Searches depth first, without recursion, because chains may have thousands of bodies.
    fn from(&mut self, root: usize) {
        self.depth[root] = 0;
        let mut way = vec![Visit { node: root, by: None, next: 0, below: 0 }];
        while let Some(visit) = way.last_mut() {
            let (node, by) = (visit.node, visit.by);
            if let Some(&(other, joint)) = self.edges[node].get(visit.next) {
                visit.next += 1;
                if Some(joint) == by {
                    continue;
                }
                if self.depth[other] == usize::MAX {
                    let below = self.stack.len();
                    self.stack.push(joint);
                    self.depth[other] = self.depth[node] + 1;
                    self.low[other] = self.depth[other];
                    way.push(Visit { node: other, by: Some(joint), next: 0, below });
                } else if self.depth[other] < self.depth[node] {
                    self.stack.push(joint);
                    self.low[node] = self.low[node].min(self.depth[other]);
                }
                continue;
            }
            let done = Visit { ..*visit };
            way.pop();
            let Some(parent) = way.last() else { continue };
            self.low[parent.node] = self.low[parent.node].min(self.low[done.node]);
            if self.low[done.node] >= self.depth[parent.node] {
                let mut joints = self.stack.split_off(done.below);
                joints.sort_unstable();
                self.found.push(joints);
            }
        }
    }
}
