//! Effects: references and numbers.

use super::vector::Place;
use super::{between, course, own, tire};
use crate::Real;
use crate::scene::{BodyId, EffectKind, JointId, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    match effect {
        EffectKind::TorsionSpring { joint, stiffness, damping, free_value } => {
            single_rotation(scene, *joint, place)?;
            place.finite("stiffness", *stiffness)?;
            place.finite("damping", *damping)?;
            place.finite("free_value", *free_value)
        }
        EffectKind::Force { body, at, course, .. } => {
            known_body(scene, *body, place)?;
            place.vector("at", *at)?;
            course::check(course, true, place)
        }
        EffectKind::BodyTorque { body, course } => {
            known_body(scene, *body, place)?;
            course::check(course, false, place)
        }
        EffectKind::JointTorque { joint, course } => {
            single_rotation(scene, *joint, place)?;
            course::check(course, false, place)
        }
        EffectKind::SpringDamper { .. }
        | EffectKind::Actuator { .. }
        | EffectKind::Polynomial { .. }
        | EffectKind::Bumper { .. }
        | EffectKind::Bushing { .. } => between::check(scene, effect, place),
        EffectKind::Limit { .. } | EffectKind::Friction { .. } => on_joint(scene, effect, place),
        EffectKind::AeroDrag { body, at, area_coefficient, density } => {
            known_body(scene, *body, place)?;
            place.vector("at", *at)?;
            place.not_negative("area_coefficient", *area_coefficient)?;
            place.not_negative("density", *density)
        }
        EffectKind::SpeedHold { body, direction, speed, gain, limit } => {
            known_body(scene, *body, place)?;
            place.axis("direction", *direction)?;
            place.finite("speed", *speed)?;
            place.not_negative("gain", *gain)?;
            place.positive("limit", *limit)
        }
        EffectKind::Tire { .. } => tire::check(scene, effect, place),
        EffectKind::Own { law, course } => own::check(scene, (law, course), place),
    }
}

/// Effects on the one coordinate of a joint.
fn on_joint<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    match effect {
        EffectKind::Limit { joint, lower, upper, stiffness, damping } => {
            single_coordinate(scene, *joint, place)?;
            place.finite("lower", *lower)?;
            place.finite("upper", *upper)?;
            place.not_negative("stiffness", *stiffness)?;
            place.not_negative("damping", *damping)?;
            if lower < upper {
                return Ok(());
            }
            let range = [lower.to_f64(), upper.to_f64()];
            place.fault("lower", SceneFault::RangeOrder(range))
        }
        EffectKind::Friction { joint, coulomb, r#static, stribeck, viscous, regularisation } => {
            single_coordinate(scene, *joint, place)?;
            place.not_negative("coulomb", *coulomb)?;
            place.not_negative("static", *r#static)?;
            place.positive("stribeck", *stribeck)?;
            place.not_negative("viscous", *viscous)?;
            place.positive("regularisation", *regularisation)?;
            if r#static >= coulomb {
                return Ok(());
            }
            let levels = [r#static.to_f64(), coulomb.to_f64()];
            place.fault("static", SceneFault::StaticBelowCoulomb(levels))
        }
        _ => Ok(()),
    }
}

pub(super) fn known_body<T>(
    scene: &Scene<T>,
    body: BodyId,
    place: Place,
) -> Result<usize, SceneError> {
    let fault = match body.index() {
        Some(index) if index < scene.bodies.len() => return Ok(index),
        Some(_) => SceneFault::UnknownReference,
        None => SceneFault::NeedsMovingBody,
    };
    Err(SceneError { entry: place.entry, field: "body", fault })
}

fn single_rotation<T>(scene: &Scene<T>, joint: JointId, place: Place) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint.index()) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_rotations(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleRotation(n)),
    }
}

pub(super) fn single_coordinate<T>(
    scene: &Scene<T>,
    joint: JointId,
    place: Place,
) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint.index()) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_coordinates(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleCoordinate(n)),
    }
}
