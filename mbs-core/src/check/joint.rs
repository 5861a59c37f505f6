//! Checks of joints: bodies, position, and the axes that the kind needs.

use crate::Real;
use crate::effects::reference::check_pair;
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_parallel, is_planar};
use crate::scene::{Joint, JointLimits, SceneError, SceneFault};

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
    check_axes(joint, place)?;
    check_limits(joint, place)
}

/// Checks the limits of a joint. They need a joint with one coordinate. The lower end of a range is below the upper one; the other limits
/// are above zero.
fn check_limits<T: Real>(joint: &Joint<T>, place: Place) -> Result<(), SceneError> {
    let JointLimits { range, effort, velocity } = &joint.limits;
    let Some(first) = joint.limits.first_key() else { return Ok(()) };
    if joint.kind.single(place.dimension).is_none() {
        let n = joint.kind.n_coordinates(place.dimension);
        return place.fault(first, SceneFault::NoSingleCoordinate(n));
    }
    if let Some([lower, upper]) = *range {
        place.finite("range", lower)?;
        place.finite("range", upper)?;
        if lower >= upper {
            let ends = [lower, upper].map(T::to_f64);
            return place.fault("range", SceneFault::EmptyRange(ends));
        }
    }
    for (key, number) in [("effort_limit", effort), ("velocity_limit", velocity)] {
        number.map_or(Ok(()), |number| place.positive(key, number))?;
    }
    Ok(())
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
