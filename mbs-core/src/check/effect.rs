//! Checks of effects: references and numbers field by field, then the check of the kind.

use super::{coupling, course};
use crate::Real;
use crate::effects::reference::{check_coordinate, check_pair, known_body};
use crate::effects::{EffectKind, Form, JointNeed, Sign, Value};
use crate::mechanism::Scene;
use crate::scene::place::{Place, is_planar};
use crate::scene::{SceneError, SceneFault};

pub(super) fn check<T: Real>(
    scene: &Scene<T>,
    effect: &EffectKind<T>,
    place: Place,
) -> Result<(), SceneError> {
    let among = scene.surroundings();
    let values = effect.values();
    let given = effect.coordinate();
    for (field, value) in effect.row().fields.iter().zip(values) {
        let key = field.key;
        match value {
            Value::Bodies(bodies) => check_pair(among, bodies, place)?,
            Value::Body(body) => {
                known_body(among, body, place)?;
            }
            Value::Joint(joint) => {
                let Form::Joint(need) = field.form else { continue };
                check_coordinate(among, joint, (need, given), place)?;
            }
            Value::Point(x) => place.vector(key, x)?,
            Value::Points(x) if field.form == Form::Points(true) => place.apart(key, x)?,
            Value::Line(points) => coupling::check_line(scene, &points, place)?,
            Value::Points(x) => x.iter().try_for_each(|x| place.vector(key, *x))?,
            Value::Axis(x) => place.axis(key, x)?,
            Value::Number(x) => match field.form {
                Form::Number(Sign::Positive) => place.positive(key, x)?,
                Form::Number(Sign::NotNegative) => place.not_negative(key, x)?,
                _ => place.finite(key, x)?,
            },
            Value::Length(length) => {
                length.iter().try_for_each(|x| place.not_negative(key, *x))?;
            }
            Value::Six(six) => check_six(key, &six, place)?,
            Value::Signal(signal) => {
                let Form::Signal(form) = field.form else { continue };
                course::check(&signal, (Some(form), scene.signals.len()), place)?;
            }
            Value::Terms(terms) => coupling::check_terms(scene, &terms, place)?,
            // checked together with the joint
            Value::Coordinate(_) => {}
            // the check of the kind covers these
            Value::MaybeAxis(_) | Value::Pieces(_) | Value::Side(_) | Value::Slip(_) => {}
            Value::Spin(joint) => {
                let Some(joint) = joint else { continue };
                let need = (JointNeed::Spin, None);
                check_coordinate(among, joint, need, place)
                    .map_err(|error| SceneError { field: key, ..error })?;
            }
            Value::Flag(_)
            | Value::Frame(_)
            | Value::Name(_)
            | Value::ForceLaw(_)
            | Value::BodyLaw(_) => {}
        }
    }
    effect.check(among, place)
}

/// Checks six numbers that are not negative. In a planar scene only the numbers along x, along y and about z may be nonzero.
fn check_six<T: Real>(field: &'static str, six: &[T; 6], place: Place) -> Result<(), SceneError> {
    six.iter().try_for_each(|x| place.not_negative(field, *x))?;
    match six[2..5].iter().find(|x| is_planar(place.dimension) && !x.is_zero()) {
        Some(x) => place.fault(field, SceneFault::OutOfPlane(x.to_f64())),
        None => Ok(()),
    }
}
