//! Joint coordinates as the tree stores them, including whole turns. They are read from the state and are not measured from the positions
//! of the bodies.

use crate::build::TreeModel;
use crate::host::state::TreeState;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::scene::BodyId;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the coordinate of a link with one freedom, or the angle of a free link in the plane, including whole turns [rad or m].
    ///
    /// Cost: one read. For a guided joint, one evaluation of its guide.
    ///
    /// # Panics
    /// If the link does not exist.
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

    /// Returns the angle of the second body relative to the first in the plane, including whole turns [rad].
    ///
    /// # Panics
    /// If one of the bodies does not exist.
    #[must_use]
    pub fn turn_between(&self, state: &TreeState<T>, bodies: [BodyId; 2]) -> T {
        self.turn_of(state, bodies.map(|body| self.link(body)))
    }
}
