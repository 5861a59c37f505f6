//! `[[effect]]`, by the table of effects of mbs-core.

use super::Value::{Flag, Number, NumberOr, Numbers, OneOrSome, Rows, Word};
use super::{Key, Part, Standing, Table, Value, inside, may, name_or, need};
use mbs_core::effects::{Default, EFFECTS, Field, Form, Row, SignalForm};

/// The tables of the kinds, those of one name together; then what stands inside them.
pub(super) fn tables() -> Vec<Table> {
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

fn table(name: &'static str, row: &'static Row) -> Table {
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
                Value::Of(Part::Joint),
                "",
                "none",
                "A ball joint in place of `terms`, beside `coordinate` and `axis`.",
            ),
            may("coordinate", Word(vec!["swing", "twist"]), "", "none", "The angle of the ball."),
            may("axis", Value::Vector, "", "none", "The axis of that angle."),
        ];
        keys.extend(angle.map(Key::in_space));
    }
    if has(Form::Line) {
        keys.push(may(
            "bodies",
            Value::Several(Part::Body, 2),
            "",
            "none",
            "The bodies of two places in `points`.",
        ));
    }
    let (kind, standing, example) = (Some(name), Standing::Listed, None);
    Table { header: "effect", kind, standing, meaning: meaning(row), keys, example }
}

/// What a kind acts on, and its law.
fn meaning(row: &Row) -> String {
    let on = match row.fields.first().map(|field| field.form) {
        Some(Form::Bodies) => "Between two bodies",
        Some(Form::Joint(_)) => "On a coordinate of a joint",
        Some(Form::Terms) => "On a sum of coordinates and lengths",
        Some(Form::Line) => "On a line over points",
        _ => "On a body",
    };
    match row.law {
        "see below" => format!("{on}: a wheel on the road; docs/EFFECTS.md has its law."),
        law => format!("{on}: {law}."),
    }
}

/// The keys of a field.
fn of_field(field: &'static Field) -> Vec<Key> {
    let default = match field.default {
        Default::Needed => None,
        Default::Number(number) => Some(number.to_owned()),
        Default::As(other) => Some(format!("as `{other}`")),
        Default::Times(number, other) => Some(format!("{number} `{other}`")),
        Default::NeededWith(other) => Some(format!("needed with `{other}`")),
        Default::NeededWithout(other) => Some(format!("needed without `{other}`")),
        Default::Open => Some("by the moved mass".to_owned()),
        Default::OpenWith(other) => Some(format!("by the moved mass where `{other}` is, else 0")),
        Default::Nothing => Some("none".to_owned()),
    };
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
        Form::Bodies => key_of(Value::Several(Part::Body, 2)),
        Form::Body => key_of(Value::Of(Part::MovingBody)),
        Form::Joint(_) | Form::Spin => key_of(Value::Of(Part::Joint)),
        Form::Coordinate => {
            vec![may(field.key, Value::Coordinate, "", "the only one, or the only turn", meaning)]
        }
        Form::Terms => {
            vec![may(field.key, Value::Tables("term"), "", "needed without `joint`", meaning)]
        }
        Form::Point => key_of(Value::Place),
        Form::Points(_) => key_of(Value::Places(2)),
        Form::Line => key_of(Value::PlacesOrTables("line point")),
        Form::Axis | Form::MaybeAxis => key_of(Value::Vector),
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
                Value::Table("calspan"),
                "",
                "those of the Iltis",
                "Coefficients of the side force.",
            ),
        ],
        Form::Slip => key_of(Value::Table("slip")),
        _ => Vec::new(),
    }
}

/// A number or vector over time, by one of four keys.
fn signal(field: &'static Field, form: SignalForm, default: &Option<String>) -> Vec<Key> {
    let value = match form {
        SignalForm::Scalar => Number,
        SignalForm::Moment => Value::NumberOrVector,
        SignalForm::Vector => Value::Vector,
        _ => Numbers(3),
    };
    let default = default.clone().unwrap_or_else(|| "needed without `table` and `signal`".into());
    vec![
        may(field.key, value, field.unit, &default, field.meaning.trim()),
        may(
            "table",
            Rows,
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
            OneOrSome(Part::Signal),
            field.unit,
            "none",
            "A signal in place of a constant; of a vector one for each component.",
        ),
    ]
}

fn slip() -> Table {
    inside(
        "slip",
        "Force of a tire by slip along its plane.",
        vec![
            need("stiffness", Number, "N", "Force by slip, where slip is small."),
            need("friction", Number, "", "Largest force, relative to the load."),
        ],
    )
}

fn calspan() -> Table {
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
