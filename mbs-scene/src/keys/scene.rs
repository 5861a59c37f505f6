//! `[scene]`, `[solver]`, and the file itself.

use super::table::{Key, KeyTable, inside, may, need, once};
use super::value::KeyValue;
use super::value::KeyValue::{Flag, Number, Numbers, Text, Vector, Word};
use mbs_core::scene::{Setting, SettingForm};

/// The header of the file itself, whose keys are the tables.
pub(crate) const FILE: &str = "scene file";

pub(super) fn tables() -> Vec<KeyTable> {
    let listed = |name, meaning| may(name, KeyValue::Tables(name), "", "none", meaning);
    let file = inside(
        FILE,
        "The tables of a scene file.",
        vec![
            need("scene", KeyValue::Table("scene"), "", "The scene as a whole."),
            listed("include", "Parts of other files."),
            listed("point", "Places by name."),
            listed("body", "Bodies."),
            listed("joint", "Joints between two bodies."),
            listed("initial", "Values and rates at the start."),
            listed("guide", "Prescribed motions."),
            listed("coupling", "Gears, racks, screws, belts, cams and ropes."),
            listed("rolling", "What rolls without slipping, and blades."),
            listed("signal", "Numbers over time, by name."),
            listed("frame", "Named places on bodies."),
            listed("shape", "Forms for pictures."),
            listed("effect", "Springs, dampers, forces, tires, friction and stops."),
            may("road", KeyValue::Table("road"), "", "level, at height 0", "The road under tires."),
            may(
                "parameters",
                KeyValue::Parameters,
                "",
                "none",
                "Numbers by name, for expressions.",
            ),
            may("solver", KeyValue::Table("solver"), "", "all defaults", "Method and steps."),
            listed("output", "Channels of the results; without one, each joint's coordinates."),
        ],
    );
    let parameters = "Numbers by name: each is a number, or an expression of others. A text stands wherever a number does.";
    vec![
        file,
        once("scene", "The scene as a whole.", keys()),
        once("parameters", parameters, Vec::new()),
    ]
}

fn keys() -> Vec<Key> {
    vec![
        may("name", Text, "", "the file's name", "Name of the scene in results."),
        need("dimension", Word(vec!["2", "3"]), "", "2: planar, x and y. 3: spatial."),
        may("gravity", Vector, "m/s^2", "no gravity", "Gravity, a vector."),
        need("duration", Number, "s", "Duration of the run."),
        may(
            "start",
            Word(vec!["initial", "equilibrium", "equilibrium-near"]),
            "",
            "initial",
            "Start from the initial conditions, from a static equilibrium, or from the one next to the reference configuration.",
        ),
        may(
            "outputs",
            Word(vec!["all"]),
            "",
            "those of `[[output]]`",
            "`all` adds values, rates and reactions of all joints, and forces of all effects.",
        ),
    ]
}

/// Keys of the table `[solver]`.
pub(super) fn solver() -> Vec<KeyTable> {
    let keys = Setting::of_table("solver").map(|(key, row)| of_setting(key, row)).collect();
    vec![once("solver", "Method and steps. The command line overrides each key.", keys)]
}

/// The key of a setting.
fn of_setting(key: &'static str, row: &'static Setting) -> Key {
    let value = match row.form {
        SettingForm::Word(words) => Word(words.to_vec()),
        SettingForm::Descending => Numbers(2),
        SettingForm::Flag => Flag,
        SettingForm::Count => KeyValue::Count,
        SettingForm::Positive => Number,
    };
    let sentences: Vec<String> =
        [row.meaning.to_owned()].into_iter().chain(row.further()).collect();
    may(key, value, row.unit, row.default, &sentences.join(" "))
}
