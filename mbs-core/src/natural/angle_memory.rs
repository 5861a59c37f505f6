//! Where a state remembers the angles of effects.

use super::layout::effect_of;
use super::model::NaturalModel;
use crate::Real;
use crate::model::Owner;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// The place in [`State::memory`](crate::model::State::memory) of the angle that `scene.effects[effect]` measures, with
    /// its turns; `None` when it measures none.
    #[must_use]
    pub fn memory_of_effect(&self, effect: usize) -> Option<usize> {
        let first = self.angles.partition_point(|&(owner, _)| effect_of(owner) < effect);
        let &(owner, place) = self.angles.get(first)?;
        (owner == Owner::Effect(effect)).then_some(place as usize)
    }

    /// The owner of each angle that a state remembers, with its place in [`State::memory`](crate::model::State::memory).
    pub fn remembered(&self) -> impl Iterator<Item = (Owner, usize)> + '_ {
        self.angles.iter().map(|&(owner, place)| (owner, place as usize))
    }
}
