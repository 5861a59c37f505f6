//! Checks of frames: their bodies, positions and axes. A frame may have the name of its own body, but not of another body.

use crate::Real;
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_parallel, is_planar};
use crate::scene::{BodyFrame, Entry, SceneError, SceneFault};

pub(super) fn check<T: Real>(scene: &Scene<T>) -> Result<(), SceneError> {
    for (i, frame) in scene.frames.iter().enumerate() {
        let place = scene.place(Entry::Frame(i));
        let namesake = scene.bodies.iter().position(|body| body.name == frame.name);
        if let Some(body) = namesake.filter(|body| frame.body.index() != Some(*body)) {
            return place.fault("name", SceneFault::NameOfBody(body));
        }
        if frame.body.index().is_some_and(|body| body >= scene.bodies.len()) {
            return place.fault("body", SceneFault::UnknownReference);
        }
        place.vector("at", frame.at)?;
        check_axes(frame, place)?;
    }
    Ok(())
}

fn check_axes<T: Real>(frame: &BodyFrame<T>, place: Place) -> Result<(), SceneError> {
    let Some([first, second]) = frame.axes else { return Ok(()) };
    if is_planar(place.dimension) {
        return place.fault("axes", SceneFault::NeedsSpatial);
    }
    place.axis("axes", first)?;
    place.axis("axes", second)?;
    if is_parallel(first, second) {
        return place.fault("axes", SceneFault::ParallelAxes);
    }
    Ok(())
}
