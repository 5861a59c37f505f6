//! Open numbers of effects: a scene leaves them out, and they follow from the scene. Each kind of effect computes them from the mass that
//! its coordinate moves.

use crate::Real;
use crate::effects::{Default, Value};
use crate::mechanism::{Effect, Scene};
use crate::scene::{Entry, JointId, Number, SceneError, SceneFault};
use crate::start::moved_mass;
use alloc::vec::Vec;

/// Number that an effect leaves open: index of the effect, place among its values, and the computed number.
struct OpenNumber {
    effect: usize,
    place: usize,
    number: f64,
}

/// Computes the open numbers of the enabled effects in `source`. The computation is in `f64`, so the number is the same in every precision.
///
/// Cost: none without such effects. Otherwise a copy of the scene, and a dense factorisation of its coordinates for each joint coordinate
/// concerned.
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

/// Open numbers in the order of the effects and of their fields.
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

/// Places and keys of the numbers that an effect leaves open.
fn open_places(effect: &Effect<Number>) -> Vec<(usize, &'static str)> {
    let fields = effect.kind.row().fields.iter().zip(effect.kind.values()).enumerate();
    let open = fields.filter(|(_, (field, value))| {
        let may_be_open = matches!(field.default, Default::Open | Default::OpenWith(_));
        may_be_open && matches!(value, Value::Number(number) if number.is_open())
    });
    open.map(|(place, (field, _))| (place, field.key)).collect()
}

/// Joint on which an effect acts.
fn joint_of(effect: &Effect<Number>) -> Option<JointId> {
    effect.kind.values().into_iter().find_map(|value| match value {
        Value::Joint(joint) => Some(joint),
        _ => None,
    })
}
