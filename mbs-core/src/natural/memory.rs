//! Where a state remembers the angles of effects.

use super::forces::Gauge;
use super::model::NaturalModel;
use crate::Real;
use crate::model::Owner;

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// The place in [`State::memory`](crate::model::State::memory) of the angle that `scene.effects[effect]` measures, with
    /// its turns; `None` when it measures none.
    #[must_use]
    pub fn memory_of_effect(&self, effect: usize) -> Option<usize> {
        // Groups of effects stand last, in the order of the effects.
        let is_before = |owner| !matches!(owner, Owner::Effect(e) if e >= effect);
        let first = self.groups.partition_point(|group| is_before(group.owner));
        let group = self.groups.get(first).filter(|group| group.owner == Owner::Effect(effect))?;
        let measures = self.measures.get(group.measures.range())?;
        measures.iter().find_map(|measure| match measure.gauge {
            Gauge::Angle { memory, .. } => Some(memory as usize),
            _ => None,
        })
    }

    /// The owner of each angle that a state remembers, with its place in [`State::memory`](crate::model::State::memory).
    pub fn remembered(&self) -> impl Iterator<Item = (Owner, usize)> + '_ {
        self.groups.iter().flat_map(|group| {
            let measures = self.measures.get(group.measures.range()).unwrap_or_default();
            measures.iter().filter_map(|measure| match measure.gauge {
                Gauge::Angle { memory, .. } => Some((group.owner, memory as usize)),
                _ => None,
            })
        })
    }
}
