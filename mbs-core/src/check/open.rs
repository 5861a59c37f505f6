//! Numbers of effects that are left out and follow from the scene: each kind says what it makes of the mass that its coordinate moves.

use crate::Real;
use crate::effects::{Default, Value};
use crate::mechanism::{Effect, Scene};
use crate::scene::{Entry, JointId, Number, SceneError, SceneFault};
use crate::start::moved_mass;
use alloc::vec::Vec;

/// A number that an effect leaves open: the place of the effect, that of the number among its values, and what it is.
struct OpenNumber {
    effect: usize,
    place: usize,
    number: f64,
}

/// Computes what `source` leaves open in its enabled effects; in `f64`, and so the same number in every precision.
///
/// Cost: nothing without such effects; else a copy of the scene, and for each joint coordinate that has one a dense factorisation of the
/// scene's coordinates.
///
/// # Errors
/// [`SceneFault::NoMovedMass`] with the effect.
pub(super) fn fill<T: Real>(
    source: &Scene<Number>,
    scene: &mut Scene<T>,
) -> Result<(), SceneError> {
    for OpenNumber { effect, place, number } in numbers(source)? {
        let kind = &mut scene.effects[effect].kind;
        let mut values = kind.values();
        values[place] = Value::Number(T::from_f64(number));
        if let Some(filled) = kind.with(values) {
            *kind = filled;
        }
    }
    Ok(())
}

/// The numbers that are left open, in the order of the effects and of their fields.
fn numbers(source: &Scene<Number>) -> Result<Vec<OpenNumber>, SceneError> {
    let mut scene = None;
    let mut numbers = Vec::new();
    for (i, effect) in source.effects.iter().enumerate().filter(|(_, effect)| effect.enabled) {
        let (places, joint) = (open_places(effect), joint_of(effect));
        let (Some(&(_, field)), Some(joint)) = (places.first(), joint) else { continue };
        if scene.is_none() {
            scene = Some(source.map(&mut Number::value::<f64>)?);
        }
        let Some(scene) = &scene else { continue };
        let kind = source.joints[joint].kind;
        let number = kind.coordinate_or_default(effect.kind.coordinate(), source.dimension);
        let mass = number.and_then(|number| moved_mass(scene, (joint, number)));
        let fault = SceneFault::NoMovedMass;
        let mass = mass.ok_or(SceneError { entry: Entry::Effect(i), field, fault })?;
        let of_key = |key| scene.effects[i].kind.open(key, mass);
        let found = places.iter().filter_map(|&(place, key)| Some((place, of_key(key)?)));
        numbers.extend(found.map(|(place, number)| OpenNumber { effect: i, place, number }));
    }
    Ok(numbers)
}

/// The places and the keys of the numbers that an effect leaves open.
fn open_places(effect: &Effect<Number>) -> Vec<(usize, &'static str)> {
    let fields = effect.kind.row().fields.iter().zip(effect.kind.values()).enumerate();
    let open = fields.filter(|(_, (field, value))| {
        let may_be_open = matches!(field.default, Default::Open | Default::OpenWith(_));
        may_be_open && matches!(value, Value::Number(number) if number.is_open())
    });
    open.map(|(place, (field, _))| (place, field.key)).collect()
}

/// The joint that an effect is on.
fn joint_of(effect: &Effect<Number>) -> Option<JointId> {
    effect.kind.values().into_iter().find_map(|value| match value {
        Value::Joint(joint) => Some(joint),
        _ => None,
    })
}
