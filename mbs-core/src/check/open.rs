//! Numbers of effects that are left out and follow from the scene: stops of a joint as stiff as its mass asks for.
//!
//! ```text
//! stiffness = m/tau^2,   damping = 2 m/tau          m: the mass that the coordinate moves [kg or kg m^2]
//! ```
//!
//! Spring and damper are then critically damped: what runs into a stop with rate v enters it by v tau/e.

use crate::Real;
use crate::effects::EffectKind;
use crate::mechanism::Scene;
use crate::scene::{Entry, Number, SceneError, SceneFault};
use crate::start::moved_mass;
use alloc::vec::Vec;

/// Time in which a stop takes up a motion [s]: some steps of 1 to 5 ms, and short beside the motions of machines.
const STOPPING_TIME: f64 = 0.02;

/// A stop that leaves numbers open: its effect, and the numbers that it leaves open.
struct OpenStop {
    effect: usize,
    stiffness: Option<f64>,
    damping: Option<f64>,
}

/// Computes what `source` leaves open in its enabled effects; in `f64`, and so the same number in every precision.
///
/// Cost: nothing without such effects; else a copy of the scene, and for each joint coordinate that has one a dense factorisation of the
/// scene's coordinates.
///
/// # Errors
/// [`SceneFault::NoMovedMass`] with the effect.
pub(super) fn fill<T: Real>(
    source: &Scene<Number>,
    scene: &mut Scene<T>,
) -> Result<(), SceneError> {
    for stop in stops(source)? {
        let EffectKind::Limit(limit) = &mut scene.effects[stop.effect].kind else { continue };
        if let Some(stiffness) = stop.stiffness {
            limit.stiffness = T::from_f64(stiffness);
        }
        if let Some(damping) = stop.damping {
            limit.damping = T::from_f64(damping);
        }
    }
    Ok(())
}

/// The stops that leave numbers open, in the order of the effects.
fn stops(source: &Scene<Number>) -> Result<Vec<OpenStop>, SceneError> {
    let mut scene = None;
    let mut stops = Vec::new();
    for (i, effect) in source.effects.iter().enumerate().filter(|(_, effect)| effect.enabled) {
        let EffectKind::Limit(limit) = &effect.kind else { continue };
        let is_open = [limit.stiffness.is_open(), limit.damping.is_open()];
        if !is_open.contains(&true) {
            continue;
        }
        if scene.is_none() {
            scene = Some(source.map(&mut Number::value::<f64>)?);
        }
        let Some(scene) = &scene else { continue };
        let kind = source.joints[limit.joint].kind;
        let number = kind.coordinate_or_default(limit.coordinate, source.dimension);
        let mass = number.and_then(|number| moved_mass(scene, (limit.joint, number)));
        let field = if is_open[0] { "stiffness" } else { "damping" };
        let fault = SceneFault::NoMovedMass;
        let mass = mass.ok_or(SceneError { entry: Entry::Effect(i), field, fault })?;
        stops.push(OpenStop {
            effect: i,
            stiffness: is_open[0].then(|| mass / (STOPPING_TIME * STOPPING_TIME)),
            damping: is_open[1].then(|| 2.0 * mass / STOPPING_TIME),
        });
    }
    Ok(stops)
}
