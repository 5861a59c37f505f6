//! Rotors of a scene: the inertia that each adds to a joint coordinate.

use crate::Real;
use crate::effects::RotorInertia;
use crate::mechanism::Scene;

/// An enabled rotor of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotorInput<T> {
    /// Index of the rotor among the effects: `scene.effects[effect]`.
    pub effect: usize,
    /// Index of the joint.
    pub joint: usize,
    /// Index of the joint's coordinate.
    pub number: usize,
    /// Inertia times the square of the gear ratio [kg m^2; kg for a slide].
    pub inertia: T,
}

impl<T: Real> RotorInput<T> {
    /// Rotors of a checked scene, in the order of its effects.
    pub fn all(scene: &Scene<T>) -> impl Iterator<Item = Self> + '_ {
        let effects = scene.effects.iter().enumerate().filter(|(_, effect)| effect.enabled);
        effects.filter_map(|(effect, of)| {
            let RotorInertia { joint, coordinate, inertia } = of.kind.rotor()?;
            let joint = joint.index();
            let kind = scene.joints.get(joint)?.kind;
            let number = kind.coordinate_or_default(coordinate, scene.dimension)?;
            Some(Self { effect, joint, number, inertia })
        })
    }
}
