//! Numbers of effects that are left out and follow from the scene: stops of a joint as stiff as its mass asks for.
//!
//! ```text
//! stiffness = m/tau^2,   damping = 2 m/tau          m: the mass that the coordinate moves [kg or kg m^2]
//! ```
//!
//! Spring and damper are then critically damped: what runs into a stop with rate v enters it by v tau/e.

use crate::Real;
use crate::effects::EffectKind;
use crate::scene::{Entry, Number, Scene, SceneError, SceneFault};
use crate::start::moved_mass;

/// Time in which a stop takes up a motion [s]: some steps of 1 to 5 ms, and short beside the motions of machines.
const STOPPING_TIME: f64 = 0.02;

/// Computes what `source` leaves open in its enabled effects.
///
/// Cost: nothing without such effects; else for each joint coordinate that has one, a dense factorisation of the scene's coordinates.
///
/// # Errors
/// [`SceneFault::NoMovedMass`] with the effect.
pub(super) fn fill<T: Real>(
    source: &Scene<Number>,
    scene: &mut Scene<T>,
) -> Result<(), SceneError> {
    for (i, effect) in source.effects.iter().enumerate().filter(|(_, effect)| effect.enabled) {
        let EffectKind::Limit(limit) = &effect.kind else { continue };
        let is_open = [limit.stiffness.is_open(), limit.damping.is_open()];
        if !is_open.contains(&true) {
            continue;
        }
        let kind = scene.joints[limit.joint].kind;
        let number = kind.coordinate_or_default(limit.coordinate, scene.dimension);
        let mass = number.and_then(|number| moved_mass(scene, (limit.joint, number)));
        let field = if is_open[0] { "stiffness" } else { "damping" };
        let fault = SceneFault::NoMovedMass;
        let mass = mass.ok_or(SceneError { entry: Entry::Effect(i), field, fault })?;
        let EffectKind::Limit(filled) = &mut scene.effects[i].kind else { continue };
        let tau = T::from_f64(STOPPING_TIME);
        if is_open[0] {
            filled.stiffness = mass / (tau * tau);
        }
        if is_open[1] {
            filled.damping = T::TWO * mass / tau;
        }
    }
    Ok(())
}
