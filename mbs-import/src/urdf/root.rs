//! Finds the root of the links of a URDF, which must form one tree.

use crate::element::Element;
use crate::robot::{Joint, Link};
use crate::source::{Fault, Read};

/// Name of the ground, which a file need not declare as a link.
pub(super) const WORLD: &str = "world";

/// Graph of links, with the joints between them.
#[derive(Debug)]
pub(super) struct Graph<'a> {
    pub(super) links: &'a [Link],
    pub(super) joints: &'a [Joint],
    /// Index that joints use for the first link.
    pub(super) first: usize,
}

impl Graph<'_> {
    fn parent(&self, joint: usize) -> usize {
        self.joints[joint].parent - self.first
    }

    /// The only link that is not the child of a joint.
    pub(super) fn root(&self, root: &Element) -> Read<usize> {
        let mut parent = vec![None; self.links.len()];
        for (number, joint) in self.joints.iter().enumerate() {
            let child = joint.child - self.first;
            if let Some(first) = parent[child].replace(number) {
                let (link, first) = (&self.links[child].name, &self.joints[first].name);
                return Err(Fault::new(
                    joint.at,
                    format!("link `{link}` is the child of a second joint"),
                    format!(
                        "the first one is `{first}`: a URDF is a tree; write a loop as MJCF or SDF"
                    ),
                ));
            }
        }
        let roots: Vec<_> = (0..parent.len()).filter(|link| parent[*link].is_none()).collect();
        match roots[..] {
            [] if self.links.is_empty() => {
                Err(root.fault("the robot has no link", "write a <link name=\"...\"/>"))
            }
            [] => Err(self.circle(0, &parent)),
            [trunk] => {
                // With one root, links that are not reached from it form a cycle.
                self.reached(trunk, &parent)?;
                Ok(trunk)
            }
            [first, second, ..] => {
                let [first, second] = [first, second].map(|link| &self.links[link]);
                Err(Fault::new(
                    second.at,
                    format!("two links have no parent: `{}` and `{}`", first.name, second.name),
                    "join them by a joint: a URDF is one tree",
                ))
            }
        }
    }

    fn reached(&self, trunk: usize, parent: &[Option<usize>]) -> Read<()> {
        // For each link, the number of the walk that first reached it, from 1. The root counts as reached before all walks.
        let mut by = vec![0; self.links.len()];
        by[trunk] = usize::MAX;
        for link in 0..self.links.len() {
            let mut at = link;
            while by[at] == 0 {
                by[at] = link + 1;
                at = parent[at].map_or(at, |joint| self.parent(joint));
            }
            if by[at] == link + 1 {
                return Err(self.circle(link, parent));
            }
        }
        Ok(())
    }

    /// The error that names the links of a cycle, which begins from the link `from`.
    fn circle(&self, from: usize, parent: &[Option<usize>]) -> Fault {
        let up = |link: usize| parent[link].map_or(link, |joint| self.parent(joint));
        let mut at = from;
        for _ in 0..=self.links.len() {
            at = up(at);
        }
        let (start, mut names) = (at, Vec::new());
        loop {
            names.push(format!("`{}`", self.links[at].name));
            at = up(at);
            if at == start {
                break;
            }
        }
        names.reverse();
        let joint = parent[start].map_or(self.links[start].at, |joint| self.joints[joint].at);
        Fault::new(
            joint,
            format!("links are each other's parents in a circle: {}", names.join(", ")),
            "a URDF is a tree: give one of these joints another parent",
        )
    }
}
