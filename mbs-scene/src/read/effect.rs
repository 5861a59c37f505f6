//! `[[effect]]`: the kinds, their keys, and who reads them.

mod course;
mod joint;
mod line;
mod load;
mod tire;

use crate::read::fields::{Fields, Read};
use mbs_core::Real;
use mbs_core::scene::{Effect, EffectKind};

/// A kind: its name, its keys, its reader.
type Kind<T> = (&'static str, &'static [&'static str], fn(&Fields<'_>) -> Read<EffectKind<T>>);

/// Every kind, in the order of the format.
fn kinds<T: Real>() -> [Kind<T>; 14] {
    [
        (
            "spring-damper",
            &["bodies", "points", "stiffness", "damping", "free_length"],
            line::spring_damper,
        ),
        ("torque", &["body", "joint", "value", "table"], load::torque),
        ("force", &["body", "at", "value", "table", "frame"], load::force),
        ("torsion-spring", &["joint", "stiffness", "damping", "free_value"], joint::torsion_spring),
        ("bumper", &["bodies", "points", "stiffness", "damping", "clearance"], line::bumper),
        ("polynomial-spring", &["bodies", "points", "coefficients", "direction"], |fields| {
            line::polynomial(fields, false)
        }),
        ("polynomial-damper", &["bodies", "points", "coefficients", "direction"], |fields| {
            line::polynomial(fields, true)
        }),
        ("actuator", &["bodies", "points", "value", "table"], line::actuator),
        ("limit", &["joint", "lower", "upper", "stiffness", "damping"], joint::limit),
        (
            "friction",
            &["joint", "coulomb", "static", "stribeck", "viscous", "regularisation"],
            joint::friction,
        ),
        ("bushing", &["bodies", "at", "stiffness", "damping"], line::bushing),
        ("aero-drag", &["body", "at", "area_coefficient", "density"], load::aero_drag),
        ("speed-hold", &["body", "direction", "speed", "gain", "limit"], load::speed_hold),
        (
            "tire",
            &[
                "body",
                "center",
                "axis",
                "radius",
                "stiffness",
                "damping",
                "rolling_resistance",
                "side",
                "coefficients",
            ],
            tire::tire,
        ),
    ]
}

const COMMON: [&str; 3] = ["name", "kind", "enabled"];

/// Reads an effect; without a name it is called `effect-N`, counted from 1.
pub(crate) fn read<T: Real>(index: usize, fields: &Fields<'_>) -> Read<Effect<T>> {
    let kinds = kinds::<T>();
    let word = fields.word("kind")?;
    let Some((_, keys, read)) = kinds.iter().find(|(name, ..)| *name == word.0) else {
        return fields.unknown_word("kind", word, &kinds.map(|(name, ..)| name));
    };
    let elsewhere: Vec<&str> = kinds.iter().flat_map(|(_, keys, _)| *keys).copied().collect();
    fields.allow(&[&COMMON, *keys].concat(), &elsewhere)?;
    let name = match fields.get("name") {
        Some(_) => fields.name()?,
        None => format!("effect-{}", index + 1),
    };
    Ok(Effect { name, enabled: fields.flag("enabled", true)?, kind: read(fields)? })
}
