//! `[[effect]]`, by the table of effects of mbs-core.

use super::table::{Key, KeyTable, Standing, inside, may, name_or, need};
use super::value::KeyValue::{Flag, Number, NumberOr, Numbers, OneOrSome, Rows, RowsOrFile, Word};
use super::value::{KeyValue, Referent};
use mbs_core::effects::{Default, EFFECTS, Field, Form, Row, SignalForm};

/// The tables of the kinds, those of one name together; then what stands inside them.
pub(super) fn tables() -> Vec<KeyTable> {
    let mut tables = Vec::new();
    let mut names: Vec<&str> = Vec::new();
    for name in EFFECTS.iter().flat_map(|row| row.names) {
        if names.contains(name) {
            continue;
        }
        names.push(name);
        let rows = EFFECTS.iter().filter(|row| row.names.contains(name));
        tables.extend(rows.map(|row| table(name, row)));
    }
    tables.extend([slip(), calspan()]);
    tables
}

fn table(name: &'static str, row: &'static Row) -> KeyTable {
    let mut keys = vec![
        name_or("`effect-N`"),
        need("kind", Word(vec![name]), "", "The kind."),
        may("enabled", Flag, "", "true", "Whether the model has it."),
    ];
    keys.extend(row.fields.iter().flat_map(of_field));
    let has = |form: Form| row.fields.iter().any(|field| field.form == form);
    if has(Form::Terms) {
        let angle = [
            may(
                "joint",
                KeyValue::Of(Referent::Joint),
                "",
                "none",
                "A ball joint in place of `terms`, beside `coordinate` and `axis`.",
            ),
            may("coordinate", Word(vec!["swing", "twist"]), "", "none", "The angle of the ball."),
            may("axis", KeyValue::Vector, "", "none", "The axis of that angle."),
        ];
        keys.extend(angle.map(Key::in_space));
    }
    if has(Form::Line) {
        keys.push(may(
            "bodies",
            KeyValue::Several(Referent::Body, 2),
            "",
            "none",
            "The bodies of two places in `points`.",
        ));
    }
    // that of a tire is long
    let law = if row.law == "see below" { "docs/EFFECTS.md has it" } else { row.law };
    let (kind, meaning, example) = (Some(name), meaning(row).to_owned(), None);
    KeyTable { header: "effect", kind, standing: Standing::Listed, meaning, law, keys, example }
}

/// Meaning of a kind: what it acts on.
fn meaning(row: &Row) -> &'static str {
    match row.fields.first().map(|field| field.form) {
        Some(Form::Bodies) => "Between two bodies.",
        Some(Form::Joint(_)) => "On a coordinate of a joint.",
        Some(Form::Terms) => "On a sum of coordinates and lengths.",
        Some(Form::Line) => "On a line over points.",
        _ => "On a body.",
    }
}

/// Words for what holds where a key is not written; `None`: it must be.
fn default(default: Default) -> Option<String> {
    match default {
        Default::Needed => None,
        Default::Number(number) => Some(number.to_owned()),
        Default::As(other) => Some(format!("as `{other}`")),
        Default::Times(number, other) => Some(format!("{number} `{other}`")),
        Default::NeededWith(other) => Some(format!("needed with `{other}`")),
        Default::NeededWithout(other) => Some(format!("needed without `{other}`")),
        Default::Open => Some("by the moved mass".to_owned()),
        Default::OpenWith(other) => Some(format!("by the moved mass where `{other}` is, else 0")),
        Default::Nothing => Some("none".to_owned()),
    }
}

/// The keys of a field.
fn of_field(field: &'static Field) -> Vec<Key> {
    let default = default(field.default);
    let meaning = field.meaning.trim();
    let key = |name, value| match &default {
        None => need(name, value, field.unit, meaning),
        Some(default) => may(name, value, field.unit, default, meaning),
    };
    let word = |name, words: &[&'static str], default| {
        may(name, Word(words.to_vec()), "", default, meaning)
    };
    let key_of = |value| vec![key(field.key, value)];
    match field.form {
        Form::Bodies => key_of(KeyValue::Several(Referent::Body, 2)),
        Form::Body => key_of(KeyValue::Of(Referent::MovingBody)),
        Form::Joint(_) | Form::Spin => key_of(KeyValue::Of(Referent::Joint)),
        Form::Coordinate => {
            vec![may(
                field.key,
                KeyValue::Coordinate,
                "",
                "the only one, or the only turn",
                meaning,
            )]
        }
        Form::Terms => {
            vec![may(field.key, KeyValue::Tables("term"), "", "needed without `joint`", meaning)]
        }
        Form::Point => key_of(KeyValue::Place),
        Form::Points(_) => key_of(KeyValue::Places(2)),
        Form::Line => key_of(KeyValue::PlacesOrTables("line point")),
        Form::Axis | Form::MaybeAxis => key_of(KeyValue::Vector),
        Form::Number(_) => key_of(Number),
        Form::Length => {
            vec![may(field.key, NumberOr(vec!["reference"]), field.unit, "reference", meaning)]
        }
        Form::Flag => vec![may(field.key, Flag, "", "false", meaning)],
        Form::Six => {
            vec![key(field.key, Numbers(6)).in_space(), key(field.key, Numbers(3)).in_the_plane()]
        }
        Form::Pieces => key_of(Rows),
        Form::Signal(form) => signal(field, form, &default),
        Form::Frame => vec![word(field.key, &["global", "body"], "global")],
        Form::Side => vec![
            word(field.key, &["none", "calspan"], "none"),
            may(
                "coefficients",
                KeyValue::Table("calspan"),
                "",
                "those of the Iltis",
                "Coefficients of the side force.",
            ),
        ],
        Form::Slip => key_of(KeyValue::Table("slip")),
        _ => Vec::new(),
    }
}

/// A number or vector over time, by one of four keys.
fn signal(field: &'static Field, form: SignalForm, default: &Option<String>) -> Vec<Key> {
    let value = match form {
        SignalForm::Scalar => Number,
        SignalForm::Moment => KeyValue::NumberOrVector,
        SignalForm::Vector => KeyValue::Vector,
        _ => Numbers(3),
    };
    let default = default.clone().unwrap_or_else(|| "needed without `table` and `signal`".into());
    vec![
        may(field.key, value, field.unit, &default, field.meaning.trim()),
        may(
            "table",
            RowsOrFile,
            field.unit,
            "none",
            "Rows `[time, value]` in place of a constant: linear, held outside.",
        ),
        may(
            "input",
            Flag,
            "",
            "false",
            "Whether it is set between steps; the value is then that at the start.",
        ),
        may(
            "signal",
            OneOrSome(Referent::Signal),
            field.unit,
            "none",
            "A signal in place of a constant; of a vector one for each component.",
        ),
    ]
}

fn slip() -> KeyTable {
    inside(
        "slip",
        "Force of a tire by slip along its plane.",
        vec![
            need("stiffness", Number, "N", "Force by slip, where slip is small."),
            need("friction", Number, "", "Largest force, relative to the load."),
        ],
    )
}

fn calspan() -> KeyTable {
    let omega = "Ratio of the load at which the cornering stiffness is largest.";
    inside(
        "calspan",
        "Coefficients of the Calspan model of side force and aligning torque.",
        vec![
            need("a", Numbers(5), "N/rad, 1/rad, N, 1/rad, N", "A0 to A4."),
            need("omega", Number, "", omega),
            need("b", Numbers(3), "1/N, -, 1/N^2", "B1, B3, B4."),
            need("skid", Number, "", "Friction of a wheel that slides whole."),
            need("trail", Numbers(2), "m/N", "AF1, AF2."),
        ],
    )
}
