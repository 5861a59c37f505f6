//! Joints: bodies, place and axes that fit the kind.

use super::vector::{Place, is_parallel};
use super::{check_pair, is_planar};
use crate::Real;
use crate::scene::{Joint, JointKind, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    joint: &Joint<T>,
    place: Place,
) -> Result<(), SceneError> {
    use JointKind::{Cylindrical, Distance, Planar, Spherical, Universal};
    check_pair(scene, joint.bodies, place)?;
    if is_planar(place.dimension)
        && matches!(joint.kind, Spherical | Universal | Cylindrical | Planar)
    {
        return place.fault("kind", SceneFault::NeedsSpatial);
    }
    if joint.kind == Distance {
        place.apart("points", joint.points)?;
    } else {
        place.vector("at", joint.points[0])?;
        if joint.points[0] != joint.points[1] {
            return place.fault("at", SceneFault::PointsDiffer);
        }
    }
    check_axes(joint, place)
}

/// How a kind uses an axis.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Needed,
    Optional,
    NeedsSpatial,
    None,
}

fn check_axes<T: Real>(joint: &Joint<T>, place: Place) -> Result<(), SceneError> {
    let planar = is_planar(place.dimension);
    let (uses, fields) = match joint.kind {
        JointKind::Revolute if planar => ([Use::None, Use::None], ["axis", "axis"]),
        JointKind::Revolute | JointKind::Prismatic | JointKind::Cylindrical => {
            ([Use::Needed, Use::None], ["axis", "axis"])
        }
        JointKind::Universal => ([Use::Needed, Use::Needed], ["axes", "axes"]),
        JointKind::Planar => ([Use::Needed, Use::Needed], ["axis", "direction"]),
        JointKind::Distance if planar => ([Use::NeedsSpatial, Use::None], ["axis", "axis"]),
        JointKind::Distance => ([Use::Optional, Use::None], ["axis", "axis"]),
        JointKind::Spherical | JointKind::Weld | JointKind::Free => {
            ([Use::None, Use::None], ["axis", "axis"])
        }
    };
    for ((axis, how), field) in joint.axes.iter().zip(uses).zip(fields) {
        match (axis, how) {
            (Some(_), Use::None) => return place.fault(field, SceneFault::NotUsed),
            (Some(_), Use::NeedsSpatial) => return place.fault(field, SceneFault::NeedsSpatial),
            (None, Use::Needed) => return place.fault(field, SceneFault::Missing),
            (Some(axis), Use::Needed | Use::Optional) => place.axis(field, *axis)?,
            (None, _) => {}
        }
    }
    match joint.axes {
        [Some(first), Some(second)] if is_parallel(first, second) => {
            place.fault(fields[1], SceneFault::ParallelAxes)
        }
        _ => Ok(()),
    }
}
