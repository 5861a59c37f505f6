//! Effects: references and numbers, field by field, then what the kind itself refuses.

use super::vector::Place;
use super::{check_pair, course, is_planar};
use crate::Real;
use crate::effects::{Form, JointNeed, Sign, Value};
use crate::scene::{BodyId, EffectKind, JointId, Scene, SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    for (field, value) in effect.row().fields.iter().zip(effect.values()) {
        let key = field.key;
        match value {
            Value::Bodies(bodies) => check_pair(scene, bodies, place)?,
            Value::Body(body) => {
                known_body(scene, body, place)?;
            }
            Value::Joint(joint) if field.form == Form::Joint(JointNeed::Rotation) => {
                single_rotation(scene, joint, place)?;
            }
            Value::Joint(joint) => single_coordinate(scene, joint, place)?,
            Value::Point(x) => place.vector(key, x)?,
            Value::Points(x) if field.form == Form::Points(true) => place.apart(key, x)?,
            Value::Points(x) => x.iter().try_for_each(|x| place.vector(key, *x))?,
            Value::Axis(x) => place.axis(key, x)?,
            Value::Number(x) => match field.form {
                Form::Number(Sign::Positive) => place.positive(key, x)?,
                Form::Number(Sign::NotNegative) => place.not_negative(key, x)?,
                _ => place.finite(key, x)?,
            },
            Value::Six(six) => check_six(key, &six, place)?,
            Value::Signal(signal) => {
                let Form::Signal(form) = field.form else { continue };
                course::check(&signal, Some(form), place)?;
            }
            // left to the kind
            Value::MaybeAxis(_) | Value::Pieces(_) | Value::Side(_) => {}
            Value::Frame(_) | Value::Name(_) | Value::ForceLaw(_) | Value::BodyLaw(_) => {}
        }
    }
    effect.check(scene, place)
}

impl Place {
    /// A signal of three free numbers.
    pub(crate) fn signal<T: Real>(
        self,
        signal: &crate::scene::Signal<T>,
    ) -> Result<(), SceneError> {
        course::check(signal, None, self)
    }
}

/// Six numbers that are not negative; in the plane only along x, y and about z.
fn check_six<T: Real>(field: &'static str, six: &[T; 6], place: Place) -> Result<(), SceneError> {
    six.iter().try_for_each(|x| place.not_negative(field, *x))?;
    match six[2..5].iter().find(|x| is_planar(place.dimension) && !x.is_zero()) {
        Some(x) => place.fault(field, SceneFault::OutOfPlane(x.to_f64())),
        None => Ok(()),
    }
}

pub(crate) fn known_body<T>(
    scene: &Scene<T>,
    body: BodyId,
    place: Place,
) -> Result<usize, SceneError> {
    let fault = match body.index() {
        Some(index) if index < scene.bodies.len() => return Ok(index),
        Some(_) => SceneFault::UnknownReference,
        None => SceneFault::NeedsMovingBody,
    };
    Err(SceneError { entry: place.entry, field: "body", fault })
}

fn single_rotation<T>(scene: &Scene<T>, joint: JointId, place: Place) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint.index()) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_rotations(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleRotation(n)),
    }
}

pub(crate) fn single_coordinate<T>(
    scene: &Scene<T>,
    joint: JointId,
    place: Place,
) -> Result<(), SceneError> {
    let Some(joint) = scene.joints.get(joint.index()) else {
        return place.fault("joint", SceneFault::UnknownReference);
    };
    match joint.kind.n_coordinates(scene.dimension) {
        1 => Ok(()),
        n => place.fault("joint", SceneFault::NoSingleCoordinate(n)),
    }
}
