//! Checks of rolling contacts: their bodies, shapes, and contact with the plane.

use crate::Real;
use crate::algebra::norm_inf;
use crate::measure::RollingInput;
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_planar};
use crate::scene::{Entry, Rolling, RollingKind, SceneError, SceneFault};

/// Largest distance from the plane at the start that counts as contact [radii]. Chosen, not tuned: numbers in files have six digits.
const TOUCHING: f64 = 1e-6;
/// Largest distance from the plane that counts as contact far from the origin, in multiples of machine precision [-]. Chosen, not tuned:
/// the distance is computed by a few sums.
const ROUNDINGS: f64 = 16.0;

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for (i, rolling) in scene.rollings.iter().enumerate() {
        let place = scene.place(Entry::Rolling(i));
        check_bodies(scene, rolling, place)?;
        check_shape(rolling, place)?;
        check_contact(&RollingInput::new(rolling, scene.dimension), rolling, place)?;
    }
    Ok(())
}

fn check_bodies<T>(scene: &Scene<T>, rolling: &Rolling<T>, place: Place) -> Result<(), SceneError> {
    let Some(body) = rolling.body.index() else {
        return place.fault("body", SceneFault::NeedsMovingBody);
    };
    if body >= scene.bodies.len() {
        return place.fault("body", SceneFault::UnknownReference);
    }
    if rolling.on.index().is_some_and(|on| on >= scene.bodies.len()) {
        return place.fault("on", SceneFault::UnknownReference);
    }
    if rolling.on == rolling.body {
        return place.fault("on", SceneFault::SameBody);
    }
    Ok(())
}

fn check_shape<T: Real>(rolling: &Rolling<T>, place: Place) -> Result<(), SceneError> {
    let planar = is_planar(place.dimension);
    let is_blade = matches!(rolling.kind, RollingKind::Blade { .. });
    place.vector(if is_blade { "at" } else { "center" }, rolling.at)?;
    match &rolling.kind {
        RollingKind::Wheel { axis, radius } => {
            if !planar {
                place.axis("axis", *axis)?;
            }
            place.positive("radius", *radius)?;
        }
        RollingKind::Ball { radius } => {
            if planar {
                return place.fault("kind", SceneFault::NeedsSpatial);
            }
            place.positive("radius", *radius)?;
        }
        RollingKind::Blade { direction } => {
            place.axis("direction", *direction)?;
            if planar && rolling.plane.is_some() {
                return place.fault("plane", SceneFault::NotUsed);
            }
        }
    }
    if let Some(plane) = &rolling.plane {
        place.vector("plane", plane.point)?;
        place.axis("plane", plane.normal)?;
    }
    Ok(())
}

fn check_contact<T: Real>(
    input: &RollingInput<T>,
    rolling: &Rolling<T>,
    place: Place,
) -> Result<(), SceneError> {
    match &rolling.kind {
        RollingKind::Wheel { .. } if input.is_along_normal() => {
            return place.fault("axis", SceneFault::LiesFlat);
        }
        RollingKind::Blade { .. } if input.is_along_normal() => {
            return place.fault("direction", SceneFault::AlongNormal);
        }
        RollingKind::Blade { .. } => return Ok(()),
        RollingKind::Wheel { .. } | RollingKind::Ball { .. } => {}
    }
    let radius = rolling.kind.radius().copied().unwrap_or(T::ZERO);
    let size = norm_inf(input.center.as_slice()).max(norm_inf(input.base.as_slice()));
    let rounding = size * T::EPSILON * T::from_f64(ROUNDINGS);
    let gap = input.gap();
    if !(gap.abs() <= (radius * T::from_f64(TOUCHING)).max(rounding)) {
        return place.fault("plane", SceneFault::Apart(gap.to_f64()));
    }
    Ok(())
}
