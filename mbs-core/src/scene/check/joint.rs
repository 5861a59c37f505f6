//! Joints: bodies, place and axes that fit the kind.

use super::reference::check_pair;
use super::vector::{Place, is_parallel, is_planar};
use crate::Real;
use crate::scene::{Joint, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    joint: &Joint<T>,
    place: Place,
) -> Result<(), SceneError> {
    check_pair(scene.surroundings(), joint.bodies, place)?;
    if is_planar(place.dimension) && joint.kind.is_spatial_only() {
        return place.fault("kind", SceneFault::NeedsSpatial);
    }
    if joint.kind.is_link() {
        place.apart("points", joint.points)?;
    } else {
        place.vector("at", joint.points[0])?;
        if joint.points[0] != joint.points[1] {
            return place.fault("at", SceneFault::PointsDiffer);
        }
    }
    check_axes(joint, place)
}

fn check_axes<T: Real>(joint: &Joint<T>, place: Place) -> Result<(), SceneError> {
    let (kind, dimension) = (joint.kind, place.dimension);
    let fields = kind.axis_keys(dimension);
    for (i, is_needed) in kind.needs_axes(dimension).into_iter().enumerate() {
        let may_hinge = kind.is_link() && i == 0;
        match joint.axes[i] {
            Some(_) if may_hinge && is_planar(dimension) => {
                return place.fault(fields[i], SceneFault::NeedsSpatial);
            }
            Some(_) if !is_needed && !may_hinge => {
                return place.fault(fields[i], SceneFault::NotUsed);
            }
            Some(axis) => place.axis(fields[i], axis)?,
            None if is_needed => return place.fault(fields[i], SceneFault::Missing),
            None => {}
        }
    }
    match joint.axes {
        [Some(first), Some(second)] if is_parallel(first, second) => {
            place.fault(fields[1], SceneFault::ParallelAxes)
        }
        _ => Ok(()),
    }
}
