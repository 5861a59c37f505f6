//! Checks of what an entry refers to: its bodies and its joint.

use super::vector::Place;
use crate::scene::{BodyId, Joint, JointId, SceneError, SceneFault, Surroundings};

/// The entry's two bodies exist and differ.
pub(crate) fn check_pair<T>(
    among: Surroundings<'_, T>,
    bodies: [BodyId; 2],
    place: Place,
) -> Result<(), SceneError> {
    let knows = |body: BodyId| body.index().is_none_or(|i| i < among.bodies.len());
    if !bodies.into_iter().all(knows) {
        return place.fault("bodies", SceneFault::UnknownReference);
    }
    if bodies[0] == bodies[1] {
        return place.fault("bodies", SceneFault::SameBody);
    }
    Ok(())
}

pub(crate) fn known_body<T>(
    among: Surroundings<'_, T>,
    body: BodyId,
    place: Place,
) -> Result<usize, SceneError> {
    let fault = match body.index() {
        Some(index) if index < among.bodies.len() => return Ok(index),
        Some(_) => SceneFault::UnknownReference,
        None => SceneFault::NeedsMovingBody,
    };
    Err(SceneError { entry: place.entry, field: "body", fault })
}

/// The joint that an entry is of.
fn joint<'a, T>(
    among: &Surroundings<'a, T>,
    joint: JointId,
    place: Place,
) -> Result<&'a Joint<T>, SceneError> {
    match among.joints.get(joint.index()) {
        Some(joint) => Ok(joint),
        None => Err(SceneError {
            entry: place.entry,
            field: "joint",
            fault: SceneFault::UnknownReference,
        }),
    }
}

pub(super) fn single_rotation<T>(
    among: Surroundings<'_, T>,
    joint: JointId,
    place: Place,
) -> Result<(), SceneError> {
    match self::joint(&among, joint, place)?.kind.n_rotations(among.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleRotation(n)),
    }
}

pub(crate) fn single_coordinate<T>(
    among: Surroundings<'_, T>,
    joint: JointId,
    place: Place,
) -> Result<(), SceneError> {
    match self::joint(&among, joint, place)?.kind.n_coordinates(among.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleCoordinate(n)),
    }
}
