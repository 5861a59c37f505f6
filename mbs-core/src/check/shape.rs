//! Checks of shapes: their bodies, forms for the scene's dimension, and sizes.

use crate::Real;
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_parallel, is_planar};
use crate::scene::{BodyShape, Entry, SceneError, SceneFault, ShapeKind};

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for (i, shape) in scene.shapes.iter().enumerate() {
        let place = scene.place(Entry::Shape(i));
        if shape.body.index().is_some_and(|body| body >= scene.bodies.len()) {
            return place.fault("body", SceneFault::UnknownReference);
        }
        check_form(shape, place)?;
        place.finite("opacity", shape.opacity)?;
        if !(T::ZERO..=T::ONE).contains(&shape.opacity) {
            return place.fault("opacity", SceneFault::NotAShare(shape.opacity.to_f64()));
        }
    }
    Ok(())
}

fn check_form<T: Real>(shape: &BodyShape<T>, place: Place) -> Result<(), SceneError> {
    let key = shape.form.key();
    let [in_the_plane, in_space] = shape.form.dimensions();
    match is_planar(place.dimension) {
        true if !in_the_plane => return place.fault(key, SceneFault::NeedsSpatial),
        false if !in_space => return place.fault(key, SceneFault::NeedsPlanar),
        _ => {}
    }
    match &shape.form {
        ShapeKind::Box { center, size, axes } => {
            place.vector(key, *center)?;
            size.iter().try_for_each(|length| place.positive(key, *length))?;
            check_axes(axes.as_ref(), key, place)?;
        }
        ShapeKind::Sphere { center, radius } | ShapeKind::Disc { center, radius } => {
            place.vector(key, *center)?;
            place.positive(key, *radius)?;
        }
        ShapeKind::Capsule { from, to, radius } | ShapeKind::Cylinder { from, to, radius } => {
            place.vector(key, *from)?;
            place.vector(key, *to)?;
            place.positive(key, *radius)?;
            if from == to {
                return place.fault(key, SceneFault::CoincidentPoints);
            }
        }
        ShapeKind::Polygon { points } => {
            points.iter().try_for_each(|point| place.vector(key, *point))?;
            if points.len() < 3 {
                let fault = SceneFault::WrongCount { needed: 3, found: points.len() };
                return place.fault(key, fault);
            }
        }
        ShapeKind::Mesh { file: _, at, axes, scale } => {
            place.vector(key, *at)?;
            check_axes(axes.as_ref(), key, place)?;
            for factor in scale {
                place.finite(key, *factor)?;
                if factor.is_zero() {
                    return place.fault(key, SceneFault::NotPositive(0.0));
                }
            }
        }
    }
    Ok(())
}

/// Checks that two axes span a plane.
fn check_axes<T: Real>(
    axes: Option<&[[T; 3]; 2]>,
    key: &'static str,
    place: Place,
) -> Result<(), SceneError> {
    let Some([first, second]) = axes else { return Ok(()) };
    place.axis(key, *first)?;
    place.axis(key, *second)?;
    if is_parallel(*first, *second) {
        return place.fault(key, SceneFault::ParallelAxes);
    }
    Ok(())
}
