//! Output channels: references and places.

use super::effect::known_body;
use super::vector::Place;
use crate::Real;
use crate::scene::{Quantity, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    quantity: &Quantity<T>,
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
            match scene.joints.get(joint.index()) {
                None => place.fault("joint", SceneFault::UnknownReference),
                Some(joint) if joint.kind.n_coordinates(scene.dimension) == 0 => {
                    place.fault("joint", SceneFault::NoCoordinate)
                }
                Some(_) => Ok(()),
            }
        }
        Quantity::Reaction { joint } if joint.index() >= scene.joints.len() => {
            place.fault("joint", SceneFault::UnknownReference)
        }
        Quantity::Reaction { .. } => Ok(()),
    }
}
