//! Poses from the element `origin`.

use crate::element::Element;
use crate::pose::{Pose, quaternion, roll_pitch_yaw, v3};
use crate::source::Read;

/// The pose in the `origin` of an element; without this element it is the identity.
pub(super) fn origin(element: &Element) -> Read<Pose> {
    let Some(origin) = element.child("origin") else { return Ok(Pose::identity()) };
    let at = v3(origin.numbers_or("xyz", [0.0; 3])?);
    let turn = match origin.attribute("quat_xyzw") {
        Some(attribute) => {
            let [x, y, z, w] = attribute.numbers()?;
            quaternion([w, x, y, z]).ok_or_else(|| {
                attribute.fault("a quaternion of length zero", "write x y z w of unit length")
            })?
        }
        None => roll_pitch_yaw(origin.numbers_or("rpy", [0.0; 3])?),
    };
    Ok(Pose::new(turn, at))
}
