//! Tires.

use super::effect::known_body;
use super::is_planar;
use super::vector::Place;
use crate::Real;
use crate::scene::{CalspanCoefficients, EffectKind, Scene, SceneError, SceneFault};

/// Numbers in range; an axis where side force or rolling resistance asks for one; nothing across in the plane.
pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    let EffectKind::Tire {
        body,
        center,
        axis,
        radius,
        stiffness,
        damping,
        rolling_resistance,
        side,
    } = effect
    else {
        return Ok(());
    };
    known_body(scene, *body, place)?;
    place.vector("center", *center)?;
    place.positive("radius", *radius)?;
    place.not_negative("stiffness", *stiffness)?;
    place.not_negative("damping", *damping)?;
    place.not_negative("rolling_resistance", *rolling_resistance)?;
    if is_planar(place.dimension) {
        if side.is_some() {
            return place.fault("side", SceneFault::NeedsSpatial);
        }
        return match axis {
            Some(_) => place.fault("axis", SceneFault::NotUsed),
            None => Ok(()),
        };
    }
    match axis {
        Some(axis) => place.axis("axis", *axis)?,
        None if side.is_some() || !rolling_resistance.is_zero() => {
            return place.fault("axis", SceneFault::Missing);
        }
        None => {}
    }
    side.as_ref().map_or(Ok(()), |coefficients| calspan(coefficients, place))
}

/// The formulas divide by A0, A2, A4 and the coefficient of friction.
fn calspan<T: Real>(c: &CalspanCoefficients<T>, place: Place) -> Result<(), SceneError> {
    let rest = [c.omega, c.skid];
    for x in c.a.iter().chain(&c.b).chain(&c.trail).chain(&rest) {
        place.finite("coefficients", *x)?;
    }
    let is_positive = [c.a[0], c.a[2], c.omega, c.b[1], c.skid].iter().all(|x| *x > T::ZERO);
    if is_positive && !c.a[4].is_zero() {
        return Ok(());
    }
    place.fault("coefficients", SceneFault::CalspanRange)
}
