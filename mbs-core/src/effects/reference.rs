//! Checks of the bodies and joints to which an entry refers.

use super::JointNeed;
use crate::scene::place::Place;
use crate::scene::{BodyId, Joint, JointId, SceneError, SceneFault, Surroundings};

/// Checks that the two bodies of an entry exist and differ.
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

/// Returns the joint to which an entry refers.
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

/// Checks that the joint has the given coordinate. If no coordinate is given, exactly one must satisfy the requirement of the
/// entry.
pub(crate) fn check_coordinate<T>(
    among: Surroundings<'_, T>,
    joint: JointId,
    (need, given): (JointNeed, Option<usize>),
    place: Place,
) -> Result<(), SceneError> {
    let (kind, dimension) = (self::joint(&among, joint, place)?.kind, among.dimension);
    let n = kind.n_coordinates(dimension);
    let needs_one = SceneFault::NeedsCoordinate { joint: kind, dimension, given };
    let Some(number) = given else {
        let (meant, fault) = match need {
            JointNeed::Rotation | JointNeed::Spin => {
                let rotations = kind.n_rotations(dimension);
                let is_only = rotations == 0 && n == 1 && need == JointNeed::Rotation;
                let meant = if is_only { n } else { rotations };
                (meant, SceneFault::NoSingleRotation(rotations))
            }
            JointNeed::Coordinate => (n, SceneFault::NoSingleCoordinate(n)),
        };
        return match kind.coordinate_names(dimension).next() {
            _ if meant == 1 => Ok(()),
            Some(_) if n > 1 => place.fault("coordinate", needs_one),
            _ => place.fault("joint", fault),
        };
    };
    match kind.freedom(dimension, number) {
        Some(_) => Ok(()),
        None if n == 0 => place.fault("joint", SceneFault::NoCoordinate),
        None if number < n => place.fault("coordinate", SceneFault::BallCoordinate),
        None => place.fault("coordinate", needs_one),
    }
}
