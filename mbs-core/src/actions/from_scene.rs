//! Actions of a scene, collected from its effects.

use super::ActionError;
use crate::Real;
use crate::effects::action::{Actions, Compiler, Tables};
use crate::inputs::{CouplingInput, Prescribed};
use crate::mechanism::Scene;
use alloc::vec::Vec;

impl<T: Real> Actions<T> {
    /// Collects the actions of the enabled effects of a checked scene.
    ///
    /// # Errors
    /// [`ActionError::LeftOut`] for an enabled effect whose Cargo feature is off.
    pub fn new(scene: &Scene<T>) -> Result<Self, ActionError> {
        let mut compiler = Compiler {
            among: scene.surroundings(),
            effect: 0,
            roads: None,
            clock: None,
            actions: Self {
                list: Vec::new(),
                prescribed: Prescribed::new(
                    &scene.guides,
                    &scene.signals,
                    scene.couplings.iter().filter_map(|coupling| CouplingInput::new(coupling).sum),
                ),
                tables: Tables::empty(),
            },
        };
        for (coupling, of) in scene.couplings.iter().enumerate() {
            if let Some(relation) = &of.relation {
                compiler.relation(coupling, relation);
            }
        }
        for (effect, e) in scene.effects.iter().enumerate().filter(|(_, e)| e.enabled) {
            if let Some((feature, false)) = e.kind.row().feature {
                return Err(ActionError::LeftOut { effect, feature });
            }
            compiler.effect = effect;
            e.kind.actions(&mut compiler);
        }
        Ok(compiler.actions)
    }
}
