//! `[[output]]`, by the quantities of mbs-core.

use super::table::{Key, KeyTable, listed, may, need};
use super::value::KeyValue::{Flag, Name, Of, OfOr, Place, Vector, Word};
use super::value::Referent;
use mbs_core::outputs::{QUANTITIES, TargetKind, VehicleSide};

/// Words of `as` for an orientation, each with the quantity that it means.
pub(crate) const FORMS: [(&str, &str); 3] = [
    ("quaternion", ORIENTATION),
    ("matrix", "rotation-matrix"),
    ("rotation-vector", "rotation-vector"),
];

/// The quantity to which `as` belongs.
pub(crate) const ORIENTATION: &str = "orientation";

/// The word for global axes, and for those of an output's own body.
pub(crate) const GLOBAL: &str = "global";
pub(crate) const OWN_BODY: &str = "body";

/// The word for angles in degrees.
pub(crate) const DEGREES: &str = "deg";

/// Kinds of targets that outputs have.
pub(super) const TARGETS: [TargetKind; 11] = [
    TargetKind::Point,
    TargetKind::RelativePoint,
    TargetKind::Body,
    TargetKind::RelativeBody,
    TargetKind::WheelCarrier,
    TargetKind::Joint,
    TargetKind::Coupling,
    TargetKind::Rolling,
    TargetKind::Effect,
    TargetKind::Signal,
    TargetKind::Scene,
];

/// A table for each.
pub(super) fn tables() -> Vec<KeyTable> {
    TARGETS.map(table).to_vec()
}

fn table(target: TargetKind) -> KeyTable {
    let rows = || QUANTITIES.iter().filter(move |row| row.target == target);
    let mut keys = vec![need("name", Name, "", "Name of the channel.")];
    keys.extend(target.keys().iter().map(|key| owner(key)));
    let words: Vec<_> = rows().flat_map(|row| [Some(row.name), row.alias]).flatten().collect();
    let first = rows().next().map_or("", |row| row.name);
    let is_default = match target {
        TargetKind::Scene | TargetKind::Body => false,
        _ => !target.is_relative(),
    };
    let key = need("quantity", Word(words.clone()), "", "What is measured.");
    keys.push(if is_default {
        Key { is_needed: false, default: first.into(), ..key }
    } else {
        key
    });
    keys.push(frame(target));
    let magnitude = "Whether a vector has its magnitude as a column too, `NAME.abs`; a reaction `NAME.F` and `NAME.M`.";
    keys.push(may("magnitude", Flag, "", "false", magnitude));
    let unit = "Angles, their rates and accelerations in degrees; of a quantity that has one.";
    keys.push(may("unit", Word(vec![DEGREES]), "", "SI units", unit));
    if words.contains(&ORIENTATION) {
        let forms = FORMS.map(|(form, _)| form).to_vec();
        keys.push(may("as", Word(forms), "", "quaternion", "Form of an `orientation`."));
    }
    listed("output", meaning(target), keys)
}

/// The axes of an output.
fn frame(target: TargetKind) -> Key {
    let words = match target.keys().first() {
        Some(&"body") => vec![GLOBAL, OWN_BODY],
        _ => vec![GLOBAL],
    };
    let default = if target.is_relative() { "those of `relative_to`" } else { GLOBAL };
    let meaning = match words.len() {
        1 => "Axes of the components of a vector: global, or those of a body.",
        _ => {
            "Axes of the components of a vector: global, or those of the body itself or of another one. What is measured stays the same."
        }
    };
    may("frame", OfOr(Referent::Body, words), "", default, meaning)
}

/// A key that says what an output is of.
fn owner(key: &'static str) -> Key {
    match key {
        "body" => need(key, Of(Referent::MovingBody), "", "The body."),
        "at" => may(key, Place, "m", "its centre of mass", "A material point of the body."),
        "relative_to" => {
            need(key, Of(Referent::Body), "", "Another body, in whose axes it is seen.")
        }
        "origin" => may(
            key,
            Place,
            "m",
            "its centre of mass",
            "The point of that body from which positions count.",
        ),
        "side" => need(
            key,
            Word(VehicleSide::ALL.map(|(_, name)| name).to_vec()),
            "",
            "Where the wheel is.",
        ),
        "up" => may(key, Vector, "", "[0, 0, 1]", "Upwards in the vehicle, as it is drawn."),
        "forward" => may(
            key,
            Vector,
            "",
            "[1, 0, 0]",
            "Forward in the vehicle, as it is drawn; its part along `up` does not count.",
        ),
        "axis" => may(
            key,
            Vector,
            "",
            "across the vehicle; of `caster`, `up`",
            "The wheel's axis, of `caster` the steering axis: a direction of the carrier, as it is drawn, in either sense.",
        ),
        "joint" => need(key, Of(Referent::Joint), "", "The joint."),
        "coupling" => need(key, Of(Referent::Coupling), "", "The coupling."),
        "rolling" => need(key, Of(Referent::Rolling), "", "What rolls."),
        "effect" => need(key, Of(Referent::Effect), "", "The effect."),
        _ => need(key, Of(Referent::Signal), "", "The signal."),
    }
}

/// Meaning of a target, as a sentence.
const fn meaning(target: TargetKind) -> &'static str {
    match target {
        TargetKind::Point => "A channel of a point of a body.",
        TargetKind::RelativePoint => "A channel of a point of a body, seen from another body.",
        TargetKind::Body => "A channel of a body.",
        TargetKind::RelativeBody => "A channel of a body, seen from another body.",
        TargetKind::WheelCarrier => {
            "A channel of the carrier of a wheel, seen from the vehicle body: camber, toe and caster by ISO 8855. In space alone."
        }
        TargetKind::Joint => {
            "A channel of a joint. Its reaction is what the first body does to the second."
        }
        TargetKind::Coupling => "A channel of a coupling.",
        TargetKind::Rolling => "A channel of what rolls.",
        TargetKind::Effect => "A channel of an effect.",
        TargetKind::Signal => "A channel of a signal.",
        TargetKind::Scene => "A channel of the whole scene.",
    }
}
