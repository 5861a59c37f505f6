//! Effects and output channels: references and numbers.

use super::motion::check_times;
use super::vector::Place;
use super::{check_pair, is_planar};
use crate::Real;
use crate::scene::{Course, EffectKind, Quantity, Scene, SceneError, SceneFault};

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
            check_course(course, true, place)
        }
        EffectKind::BodyTorque { body, course } => {
            known_body(scene, *body, place)?;
            check_course(course, false, place)
        }
        EffectKind::JointTorque { joint, course } => {
            single_rotation(scene, *joint, place)?;
            check_course(course, false, place)
        }
        _ => Ok(()),
    }
}

pub(super) fn check_output<T: Real>(
    scene: &Scene<T>,
    quantity: &Quantity,
    place: Place,
) -> Result<(), SceneError> {
    match *quantity {
        Quantity::Position { body, at }
        | Quantity::Velocity { body, at }
        | Quantity::Acceleration { body, at } => {
            known_body(scene, body, place)?;
            place.vector("at", at)
        }
        Quantity::JointValue { joint } | Quantity::JointRate { joint } => {
            match scene.joints.get(joint) {
                None => place.fault("joint", SceneFault::UnknownReference),
                Some(joint) if joint.kind.n_coordinates(scene.dimension) == 0 => {
                    place.fault("joint", SceneFault::NoCoordinate)
                }
                Some(_) => Ok(()),
            }
        }
        Quantity::Reaction { joint } if joint >= scene.joints.len() => {
            place.fault("joint", SceneFault::UnknownReference)
        }
        Quantity::Reaction { .. } => Ok(()),
    }
}

fn known_body<T>(scene: &Scene<T>, body: usize, place: Place) -> Result<(), SceneError> {
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

/// Finite numbers, in the plane where a vector is meant, and increasing times.
fn check_course<T: Real>(
    course: &Course<T>,
    is_vector: bool,
    place: Place,
) -> Result<(), SceneError> {
    let row = |field, value: [T; 3]| {
        if is_vector && is_planar(place.dimension) {
            return place.vector(field, value);
        }
        value.into_iter().try_for_each(|x| place.finite(field, x))
    };
    match course {
        Course::Constant(value) | Course::Input(value) => row("value", *value),
        Course::Table(rows) => {
            for (time, value) in rows {
                place.finite("table", *time)?;
                row("table", *value)?;
            }
            check_times(rows.iter().map(|row| row.0), place)
        }
    }
}
