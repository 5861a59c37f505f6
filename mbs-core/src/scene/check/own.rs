//! Laws of a user's own: where they act, and their input. The law itself is code.

use super::effect::{known_body, single_coordinate};
use super::vector::Place;
use super::{check_pair, course};
use crate::Real;
use crate::scene::{Scene, SceneError, Signal, UserLaw};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    (law, input): (&UserLaw<T>, &Signal<T>),
    place: Place,
) -> Result<(), SceneError> {
    course::check(input, false, place)?;
    match law {
        UserLaw::Length { bodies, points, .. } => {
            check_pair(scene, *bodies, place)?;
            place.apart("points", *points)
        }
        UserLaw::Joint { joint, .. } => single_coordinate(scene, *joint, place),
        UserLaw::Body { body, at, axis, .. } => {
            known_body(scene, *body, place)?;
            place.vector("at", *at)?;
            place.axis("axis", *axis)
        }
    }
}
