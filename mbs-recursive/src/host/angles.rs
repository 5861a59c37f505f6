//! Joint coordinates with their turns, as the tree has them: nothing of them is measured.

use crate::build::TreeModel;
use crate::host::state::TreeState;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::scene::BodyId;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// The coordinate of a link of one freedom, or the angle of a free one in the plane, with its turns [rad or m].
    ///
    /// Cost: none; for a guided joint, its law.
    ///
    /// # Panics
    /// If there is no such link.
    #[must_use]
    pub fn coordinate(&self, state: &TreeState<T>, link: u32) -> T {
        let link = &self.links[link as usize];
        if link.kind.is_guided() {
            let guide = link.v as usize;
            let input = self.prescribed.guide_input(guide).ok();
            let law = || self.prescribed.guide_at(guide, state.t)[0];
            input.map_or_else(law, |place| state.applied[place.start])
        } else {
            state.z[link.z as usize]
        }
    }

    /// The angle of the second body against the first in the plane, with its turns [rad].
    ///
    /// # Panics
    /// If there is no such body.
    #[must_use]
    pub fn turn_between(&self, state: &TreeState<T>, bodies: [BodyId; 2]) -> T {
        self.turn_of(state, bodies.map(|body| self.link(body)))
    }
}
