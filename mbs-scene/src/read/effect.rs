//! `[[effect]]`: the kinds, their keys, and who reads them.

mod course;
mod joint;
mod line;
mod load;
mod tire;

use crate::read::fields::{Fields, Read};
use mbs_core::scene::{Effect, EffectKind, Number};

/// A kind: its name, its keys, its reader.
type Kind = (&'static str, &'static [&'static str], fn(&Fields<'_>) -> Read<EffectKind<Number>>);

/// Every kind, in the order of the format.
fn kinds() -> [Kind; 14] {
    [
        (
            "spring-damper",
            &["bodies", "points", "stiffness", "damping", "free_length"],
            line::spring_damper,
        ),
        ("torque", &["body", "joint", "value", "table", "input"], load::torque),
        ("force", &["body", "at", "value", "table", "input", "frame"], load::force),
        ("torsion-spring", &["joint", "stiffness", "damping", "free_value"], joint::torsion_spring),
        ("bumper", &["bodies", "points", "stiffness", "damping", "clearance"], line::bumper),
        ("polynomial-spring", &["bodies", "points", "coefficients", "direction"], |fields| {
            line::polynomial(fields, false)
        }),
        ("polynomial-damper", &["bodies", "points", "coefficients", "direction"], |fields| {
            line::polynomial(fields, true)
        }),
        ("actuator", &["bodies", "points", "value", "table", "input"], line::actuator),
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
pub(crate) fn read(index: usize, fields: &Fields<'_>) -> Read<Effect<Number>> {
    let kinds = kinds();
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
