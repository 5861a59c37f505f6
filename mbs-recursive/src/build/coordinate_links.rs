//! Links that carry the coordinates of joints.

use crate::build::tree::{TreeModel, parts};
use crate::link::LinkKind;
use crate::space::Space;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::scene::Scene;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the link of each joint coordinate, indexed by joint and by coordinate of the joint. A coordinate of a cut joint or of a
    /// rotation in space has no link: `None`.
    #[must_use]
    pub fn coordinate_links(&self, scene: &Scene<T>) -> Vec<Vec<Option<u32>>> {
        let count = |joint: &mbs_core::scene::Joint<T>| joint.kind.n_coordinates(scene.dimension);
        let mut links: Vec<_> = scene.joints.iter().map(|joint| vec![None; count(joint)]).collect();
        for seat in &self.seats {
            let Some(joint) = seat.branch.joint else { continue };
            let kind = self.links[seat.link as usize].kind;
            match kind {
                // In the plane, the first coordinate of a free link is its angle relative to the ground, which is the last coordinate of its
                // joint.
                LinkKind::Free => {
                    let is_plain = S::DIMENSION == 2 && !seat.branch.is_reversed;
                    if let (true, Some(last)) = (is_plain, links[joint].last_mut()) {
                        *last = Some(seat.link);
                    }
                }
                LinkKind::Revolute
                | LinkKind::Prismatic
                | LinkKind::Ball
                | LinkKind::GuidedRevolute
                | LinkKind::GuidedPrismatic
                | LinkKind::GuidedBall => {
                    let parts = parts(scene, &seat.branch, kind.is_guided());
                    for (link, part) in (seat.first..).zip(parts) {
                        let is_known = !matches!(part.kind, LinkKind::Ball | LinkKind::GuidedBall);
                        links[joint][part.number] = is_known.then_some(link);
                    }
                }
            }
        }
        links
    }
}
