//! Joint coordinates, including whole turns, as the tree stores them. They are coordinates of the state and need no measurement.

use crate::build::TreeModel;
use crate::host::state::TreeState;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::scene::BodyId;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the coordinate of a link with one freedom, or the angle of a free link in the plane, including whole turns [rad or m].
    ///
    /// Cost: one read; for a guided joint, an evaluation of its law.
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

    /// Returns the angle of the second body against the first in the plane, including whole turns [rad].
    ///
    /// # Panics
    /// If there is no such body.
    #[must_use]
    pub fn turn_between(&self, state: &TreeState<T>, bodies: [BodyId; 2]) -> T {
        self.turn_of(state, bodies.map(|body| self.link(body)))
    }
}
