//! Reads the element `pose`: three lengths, and a rotation in one of two forms.

use crate::element::Element;
use crate::pose::{Pose, quaternion, roll_pitch_yaw, v3};
use crate::source::Read;

/// The pose of an element, and the name of the frame to which it is relative, if one is named. Without the element it is the identity.
pub(super) fn pose(element: &Element) -> Read<(Pose, Option<&str>)> {
    let Some(pose) = element.child("pose") else { return Ok((Pose::identity(), None)) };
    // Versions before 1.7 call the attribute `frame`.
    let in_frame = pose.value("relative_to").or_else(|| pose.value("frame"));
    let in_frame = in_frame.filter(|name| !name.is_empty());
    let is_in_degrees = pose.attribute("degrees").map_or(Ok(false), |degrees| degrees.flag())?;
    let content = pose.content();
    let form = pose.value("rotation_format").unwrap_or("euler_rpy");
    let numbers = content.list()?;
    let pose = match (form, &numbers[..]) {
        (_, []) => Pose::identity(),
        ("euler_rpy", &[x, y, z, roll, pitch, yaw]) => {
            let angle = |x: f64| if is_in_degrees { x.to_radians() } else { x };
            Pose::new(roll_pitch_yaw([roll, pitch, yaw].map(angle)), v3([x, y, z]))
        }
        ("quat_xyzw", &[x, y, z, qx, qy, qz, qw]) => {
            let turn = quaternion([qw, qx, qy, qz]).ok_or_else(|| {
                content.fault("a quaternion of length zero", "write x y z w of unit length")
            })?;
            Pose::new(turn, v3([x, y, z]))
        }
        ("euler_rpy" | "quat_xyzw", _) => {
            let n = numbers.len();
            return Err(content.fault(
                format!("`pose` has {n} numbers"),
                "write x y z roll pitch yaw, or with rotation_format=\"quat_xyzw\" x y z and the quaternion x y z w",
            ));
        }
        (other, _) => {
            return Err(content.fault(
                format!("unknown rotation_format `{other}`"),
                "write `euler_rpy` or `quat_xyzw`",
            ));
        }
    };
    Ok((pose, in_frame))
}
