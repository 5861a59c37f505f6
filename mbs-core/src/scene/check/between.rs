//! Effects between two bodies: along the line of two points, or at a place.

use super::vector::Place;
use super::{check_pair, course, is_planar, polynomial};
use crate::Real;
use crate::scene::{EffectKind, Scene, SceneError, SceneFault};

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
        _ => Ok(()),
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
