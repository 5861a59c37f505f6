//! Effects: references and numbers.

use super::vector::Place;
use super::{check_pair, course, is_planar, polynomial, tire};
use crate::Real;
use crate::scene::{EffectKind, OwnLaw, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    match effect {
        EffectKind::SpringDamper { bodies, points, stiffness, damping, free_length } => {
            check_pair(scene, *bodies, place)?;
            place.apart("points", *points)?;
            place.finite("stiffness", *stiffness)?;
            place.finite("damping", *damping)?;
            place.finite("free_length", *free_length)
        }
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
        EffectKind::Actuator { bodies, points, course } => {
            check_pair(scene, *bodies, place)?;
            place.apart("points", *points)?;
            course::check(course, false, place)
        }
        EffectKind::Polynomial { bodies, points, direction, pieces, .. } => {
            check_pair(scene, *bodies, place)?;
            match direction {
                // a distance along a line may be zero
                Some(direction) => {
                    points.iter().try_for_each(|point| place.vector("points", *point))?;
                    place.axis("direction", *direction)?;
                }
                None => place.apart("points", *points)?,
            }
            polynomial::check(pieces, place)
        }
        EffectKind::Bumper { bodies, points, stiffness, damping, clearance } => {
            check_pair(scene, *bodies, place)?;
            place.apart("points", *points)?;
            place.not_negative("stiffness", *stiffness)?;
            place.not_negative("damping", *damping)?;
            place.finite("clearance", *clearance)
        }
        EffectKind::Bushing { bodies, at, stiffness, damping } => {
            check_pair(scene, *bodies, place)?;
            place.vector("at", *at)?;
            bushing("stiffness", stiffness, place)?;
            bushing("damping", damping, place)
        }
        EffectKind::Limit { .. } | EffectKind::Friction { .. } => on_joint(scene, effect, place),
        EffectKind::Own { law, course } => {
            own(scene, law, place)?;
            course::check(course, false, place)
        }
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

/// Where a law of a user's own acts; what it does is its own affair.
fn own<T: Real>(scene: &Scene<T>, law: &OwnLaw<T>, place: Place) -> Result<(), SceneError> {
    match law {
        OwnLaw::Length { bodies, points, .. } => {
            check_pair(scene, *bodies, place)?;
            place.apart("points", *points)
        }
        OwnLaw::Joint { joint, .. } => single_coordinate(scene, *joint, place),
        OwnLaw::Body { body, at, axis, .. } => {
            known_body(scene, *body, place)?;
            place.vector("at", *at)?;
            place.axis("axis", *axis)
        }
    }
}

/// Six numbers that are not negative; in the plane only along x, y and about z.
fn bushing<T: Real>(field: &'static str, six: &[T; 6], place: Place) -> Result<(), SceneError> {
    six.iter().try_for_each(|x| place.not_negative(field, *x))?;
    match six[2..5].iter().find(|x| is_planar(place.dimension) && !x.is_zero()) {
        Some(x) => place.fault(field, SceneFault::OutOfPlane(x.to_f64())),
        None => Ok(()),
    }
}

pub(super) fn known_body<T>(scene: &Scene<T>, body: usize, place: Place) -> Result<(), SceneError> {
    if body < scene.bodies.len() {
        Ok(())
    } else {
        place.fault("body", SceneFault::UnknownReference)
    }
}

fn single_rotation<T>(scene: &Scene<T>, joint: usize, place: Place) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_rotations(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleRotation(n)),
    }
}

fn single_coordinate<T>(scene: &Scene<T>, joint: usize, place: Place) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_coordinates(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleCoordinate(n)),
    }
}
