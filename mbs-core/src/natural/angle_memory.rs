//! Angles that a state remembers, to count full turns, and their places.

use super::layout::effect_of;
use super::model::NaturalModel;
use crate::Real;
use crate::effects::action::{Action, Actions};
use crate::joint::Freedom;
use crate::mechanism::Scene;
use crate::model::Owner;
use alloc::vec::Vec;

/// Angle of a joint that a state remembers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RememberedAngle<T> {
    /// Joint, and the number of its coordinate.
    pub of: (usize, usize),
    /// Sign of the coordinate relative to the remembered angle, 1 or -1.
    pub sign: T,
    /// Place of the angle in [`State::memory`](crate::model::State::memory).
    pub place: usize,
}

impl<T: Real, const D: usize> NaturalModel<T, D> {
    /// Place in [`State::memory`](crate::model::State::memory) of the angle, with full turns, that `scene.effects[effect]`
    /// measures. `None` if the effect measures no angle.
    #[must_use]
    pub fn memory_of_effect(&self, effect: usize) -> Option<usize> {
        let first = self.angles.partition_point(|&(owner, _)| effect_of(owner) < effect);
        let &(owner, place) = self.angles.get(first)?;
        (owner == Owner::Effect(effect)).then_some(place as usize)
    }

    /// Joint coordinates that a state remembers with full turns, for the couplings and effects of the scene of this model. In the
    /// plane they include the angles of bushings between the bodies of a joint.
    ///
    /// Cost: one pass over the effects, whose actions are computed again.
    #[must_use]
    pub fn remembered_coordinates(&self, scene: &Scene<T>) -> Vec<RememberedAngle<T>> {
        let coupled = self.coupled_angles();
        let mut all: Vec<_> =
            coupled.map(|(of, sign, place)| RememberedAngle { of, sign, place }).collect();
        if self.angles.is_empty() {
            return all;
        }
        // The actions of a scene that has a model exist.
        let actions = Actions::new(scene).map(|actions| actions.list).unwrap_or_default();
        for (effect, action) in actions {
            let Some(place) = self.memory_of_effect(effect) else { continue };
            match action {
                Action::Angle { joint, number, .. } => {
                    all.push(RememberedAngle { of: (joint, number), sign: T::ONE, place });
                }
                Action::Turn { bodies, .. } => {
                    for (joint, of) in scene.joints.iter().enumerate() {
                        let sign = match of.bodies {
                            same if same == bodies => T::ONE,
                            [b, a] if [a, b] == bodies => -T::ONE,
                            _ => continue,
                        };
                        let mut freedoms = of.kind.numbered(scene.dimension);
                        let turn = freedoms.find(|(_, of)| matches!(of, Freedom::Turn(_)));
                        if let Some((number, _)) = turn {
                            all.push(RememberedAngle { of: (joint, number), sign, place });
                        }
                    }
                }
                _ => {}
            }
        }
        all
    }

    /// Owner of each angle that a state remembers, with its place in [`State::memory`](crate::model::State::memory).
    pub fn remembered(&self) -> impl Iterator<Item = (Owner, usize)> + '_ {
        self.angles.iter().map(|&(owner, place)| (owner, place as usize))
    }
}
