//! Checks of output channels: their references and positions.

use crate::Real;
use crate::effects::reference::known_body;
use crate::joint::Dimension;
use crate::mechanism::{Output, Scene};
use crate::outputs::magnitudes;
use crate::scene::place::{Place, is_parallel};
use crate::scene::{BodyId, Quantity, RelativePoint, SceneError, SceneFault, Target, WheelCarrier};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    output: &Output<T>,
    place: Place,
) -> Result<(), SceneError> {
    let quantity = &output.quantity;
    of_target(scene, quantity, place)?;
    if output.magnitude && magnitudes(&quantity.components(scene)).is_empty() {
        return place.fault("magnitude", SceneFault::NoVector);
    }
    if output.is_in_degrees && output.places_in_degrees(scene).is_empty() {
        return place.fault("unit", SceneFault::NoAngle);
    }
    let Some(frame) = output.frame else { return Ok(()) };
    known_frame(scene, frame, ("frame", place))?;
    if magnitudes(&quantity.components(scene)).is_empty() {
        return place.fault("frame", SceneFault::NoVector);
    }
    Ok(())
}

fn of_target<T: Real>(
    scene: &Scene<T>,
    quantity: &Quantity<T>,
    place: Place,
) -> Result<(), SceneError> {
    match quantity.target() {
        Target::Point(body, at) => {
            known_body(scene.surroundings(), body, place)?;
            place.vector("at", at)
        }
        Target::RelativePoint(RelativePoint { body, at, relative_to, origin }) => {
            known_body(scene.surroundings(), body, place)?;
            place.vector("at", at)?;
            known_frame(scene, relative_to, ("relative_to", place))?;
            place.vector("origin", origin)
        }
        Target::RelativeBody(body, relative_to) => {
            known_body(scene.surroundings(), body, place)?;
            known_frame(scene, relative_to, ("relative_to", place))
        }
        Target::WheelCarrier(of) => of_wheel(scene, &of, place),
        Target::Body(body) => known_body(scene.surroundings(), body, place).map(drop),
        Target::Joint(joint) => match scene.joints.get(joint.index()) {
            None => place.fault("joint", SceneFault::UnknownReference),
            Some(_) if quantity.components(scene).is_empty() => {
                place.fault("joint", SceneFault::NoCoordinate)
            }
            Some(_) => Ok(()),
        },
        Target::Coupling(coupling) if coupling.index() >= scene.couplings.len() => {
            place.fault("coupling", SceneFault::UnknownReference)
        }
        Target::Coupling(_) if quantity.components(scene).is_empty() => {
            place.fault("quantity", SceneFault::NoLine)
        }
        Target::Effect(effect) => match scene.effects.get(effect.index()) {
            None => place.fault("effect", SceneFault::UnknownReference),
            Some(_) if quantity.components(scene).is_empty() => {
                place.fault("quantity", quantity.row().components.fault_of_effect())
            }
            Some(_) => Ok(()),
        },
        Target::Signal(signal) if signal.index() >= scene.signals.len() => {
            place.fault("signal", SceneFault::UnknownReference)
        }
        Target::Rolling(rolling) if rolling.index() >= scene.rollings.len() => {
            place.fault("rolling", SceneFault::UnknownReference)
        }
        Target::Coupling(_) | Target::Rolling(_) | Target::Signal(_) | Target::Scene => Ok(()),
    }
}

/// Checks camber, toe and caster. These angles need a spatial scene and two directions that span a plane.
fn of_wheel<T: Real>(
    scene: &Scene<T>,
    of: &WheelCarrier<T>,
    place: Place,
) -> Result<(), SceneError> {
    if scene.dimension == Dimension::Planar {
        return place.fault("quantity", SceneFault::NeedsSpatial);
    }
    known_body(scene.surroundings(), of.body, place)?;
    known_frame(scene, of.relative_to, ("relative_to", place))?;
    place.axis("up", of.up)?;
    place.axis("forward", of.forward)?;
    if is_parallel(of.up, of.forward) {
        return place.fault("forward", SceneFault::ParallelAxes);
    }
    of.axis.map_or(Ok(()), |axis| place.axis("axis", axis))
}

/// Checks that a body exists, or is the ground.
fn known_frame<T>(
    scene: &Scene<T>,
    body: BodyId,
    (key, place): (&'static str, Place),
) -> Result<(), SceneError> {
    match body {
        BodyId::Body(i) if i >= scene.bodies.len() => {
            place.fault(key, SceneFault::UnknownReference)
        }
        _ => Ok(()),
    }
}
