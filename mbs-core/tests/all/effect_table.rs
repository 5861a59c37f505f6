//! Table of effects: its fields are consistent, values reproduce the effect that they come from, and docs/EFFECTS.md is written
//! from the table.

use crate::document::written;
use mbs_core::effects::{
    ActsOn, Default, EFFECTS, EffectPicture, Field, Form, JointNeed, Places, Row, UnitHint, Value,
};
use mbs_core::scene::{BodyId, Dimension, EffectKind, JointId};
use mbs_testkit::effects;
use std::collections::BTreeSet;
use std::fmt::Write;

const DOCUMENT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/EFFECTS.md");

#[test]
fn fields_have_keys_of_their_own_and_defaults_name_other_ones() {
    for row in EFFECTS {
        let keys: Vec<_> = row.fields.iter().flat_map(Field::keys).collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len(), "{}", row.module);
        for field in row.fields {
            assert!(field.meaning.trim().ends_with('.'), "{}: {}", row.module, field.key);
            let (Default::As(key)
            | Default::Times(_, key)
            | Default::NeededWith(key)
            | Default::NeededWithout(key)
            | Default::OpenWith(key)) = field.default
            else {
                continue;
            };
            let other = row.fields.iter().find(|other| other.key == key);
            let other = other.unwrap_or_else(|| panic!("{}: no key {key}", row.module));
            let is_known = match field.default {
                Default::NeededWithout(_) => other.form == Form::Flag,
                Default::OpenWith(_) => other.default == Default::Open,
                _ => matches!(other.default, Default::Needed | Default::Number(_)),
            };
            assert!(is_known, "{key}");
        }
        assert!(row.names.is_empty() || !row.law.is_empty(), "{}: no law", row.module);
    }
}

#[test]
fn values_make_the_effect_that_they_came_from() {
    for dimension in [Dimension::Planar, Dimension::Spatial] {
        for (what, kind) in effects::every(dimension) {
            let row = EFFECTS.iter().position(|row| row == kind.row()).expect("a row");
            assert_eq!(EffectKind::of(row, kind.values()).as_ref(), Some(&kind), "{what}");
            assert!(kind.row().names.contains(&kind.name()), "{what}");
            // Conversion to another type of number and back.
            let there = kind.clone().map(&mut |x: f64| x.to_bits()).expect("not a law in code");
            assert_eq!(there.map(&mut f64::from_bits).as_ref(), Some(&kind), "{what}");
            // A missing value, or a value of another form, makes no effect.
            let mut values = kind.values();
            values.pop();
            assert_eq!(EffectKind::of(row, values.clone()), None, "{what}");
            values.insert(0, Value::Name(true));
            assert_eq!(EffectKind::of(row, values), None, "{what}");
        }
    }
}

/// Example of each kind that has a name in scene files, with its row.
fn examples() -> impl Iterator<Item = (&'static Row, EffectKind<f64>)> {
    let pair = ([BodyId::Ground, BodyId::Body(0)], [[0.0; 3], [3.0, 4.0, 0.0]]);
    let (body, joint) = ((BodyId::Body(0), [1.0, 0.0, 0.0]), JointId::new(0));
    let places = Places { pair, body, joint };
    let rows = EFFECTS.iter().enumerate();
    rows.filter_map(move |(i, row)| Some((row, EffectKind::example(i, &places)?)))
}

#[test]
fn a_kind_is_drawn_as_where_it_acts_and_what_stands_on_the_road_is_a_wheel() {
    for (row, kind) in examples() {
        let picture = kind.drawn_as();
        let is_line = matches!(picture, EffectPicture::Line(_));
        assert_eq!(is_line, kind.acts_on() == ActsOn::Line, "{}: {picture:?}", row.module);
        let wheel = kind.road_wheel();
        assert_eq!(wheel.is_some(), row.needs_road, "{}", row.module);
        let drawn = if let EffectPicture::Wheel(wheel) = picture { Some(wheel) } else { None };
        assert_eq!(drawn, wheel, "{}", row.module);
    }
}

#[test]
fn what_a_kind_says_of_its_numbers_is_of_its_fields() {
    let mut hinted = Vec::new();
    for (row, kind) in examples() {
        let has = |key: &str| row.fields.iter().any(|field| field.key == key);
        let unit = |key: &str| row.fields.iter().find(|field| field.key == key).map(|f| f.unit);
        for hint in kind.unit_hints(&[]) {
            let (key, units) = match hint {
                UnitHint::Angle { key, .. } => (key, &["rad", "rad or m"][..]),
                UnitHint::FreeLength { key, in_place, .. } => {
                    assert!((in_place - 5.0).abs() < 1e-15, "{}: {in_place}", row.module);
                    (key, &["m"][..])
                }
                UnitHint::Stiffness { key, .. } => (key, &["N/m"][..]),
            };
            assert!(unit(key).is_some_and(|unit| units.contains(&unit)), "{}: {key}", row.module);
            hinted.push((row.module, key));
        }
        // Friction whose force rises steeply within a small rate can hold bodies at rest. Steps must not skip it.
        assert_eq!(kind.sticking().is_some(), has("regularisation"), "{}", row.module);
        for field in row.fields {
            let is_open = matches!(field.default, Default::Open | Default::OpenWith(_));
            let answer = kind.open(field.key, 2.0);
            assert_eq!(answer.is_some(), is_open, "{}: {}", row.module, field.key);
        }
        let has_signal = row.fields.iter().any(|field| matches!(field.form, Form::Signal(_)));
        assert_eq!(kind.signal().is_some(), has_signal, "{}", row.module);
    }
    let seen = [
        ("spring_damper", "free_length"),
        ("spring_damper", "stiffness"),
        ("torsion_spring", "free_value"),
        ("limit", "upper"),
    ];
    assert_eq!(hinted, seen, "the numbers whose units the doctor looks at");
}

#[test]
fn every_kind_is_tried_by_the_tests_of_effects() {
    let tried = effects::every(Dimension::Spatial);
    for row in EFFECTS.iter().filter(|row| row.feature.is_some() && !row.names.is_empty()) {
        assert!(tried.iter().any(|(_, kind)| kind.row() == row), "{}", row.module);
    }
}

/// Writes the tables of docs/EFFECTS.md if MBS_WRITE_DOCS is set.
#[test]
fn the_document_has_the_fields_of_the_table() {
    let text = std::fs::read_to_string(DOCUMENT).expect("the document");
    let mut expected = text.clone();
    for (heading, group) in [
        ("Between two bodies", 0),
        ("On a line over points", 4),
        ("On a joint", 1),
        ("On a sum", 2),
        ("On one body", 3),
    ] {
        let section = expected.find(&format!("## {heading}\n")).expect("a section");
        let start = section + expected[section..].find("| kind |").expect("a table");
        let end = start + expected[start..].find("\n\n").expect("an end") + 1;
        expected.replace_range(start..end, &table(group));
    }
    written(DOCUMENT, (&text, &expected));
}

/// Table of one group of kinds: between two bodies, on a joint, on a sum, on one body, on a line through points.
fn table(group: usize) -> String {
    let mut text = "| kind | keys: unit, default | law and range |\n|---|---|---|\n".to_owned();
    let group_of = |row: &&Row| match row.fields.first().map(|field| field.form) {
        Some(Form::Bodies) => 0,
        Some(Form::Joint(_)) => 1,
        Some(Form::Terms) => 2,
        Some(Form::Line) => 4,
        _ => 3,
    };
    for row in EFFECTS.iter().filter(|row| group_of(row) == group) {
        let keys: Vec<_> = row.fields.iter().filter_map(key).collect();
        for name in row.names {
            writeln!(text, "| `{name}` | {} | {} |", keys.join("; "), row.law).expect("a text");
        }
    }
    text
}

/// Key, unit and default of a field.
fn key(field: &Field) -> Option<String> {
    let key = field.key;
    let named = match field.form {
        Form::Bodies | Form::Points(_) | Form::Name(_) => return None,
        Form::Coordinate | Form::Terms | Form::Line => return None,
        Form::Joint(JointNeed::Rotation | JointNeed::Spin) => {
            format!("`{key}` with one rotation or one coordinate, or with a `coordinate`")
        }
        Form::Joint(JointNeed::Coordinate) => {
            format!("`{key}` with one coordinate, or with a `coordinate`")
        }
        Form::Pieces => format!("`{key} = [[lower, upper, c0, c1, ...], ...]`"),
        Form::Frame => format!("`{key}`, `\"global\"` or `\"body\"`"),
        Form::Side => {
            format!("`{key}`, `\"none\"` or `\"calspan\"`; `coefficients`, those of the Iltis")
        }
        Form::MaybeAxis => format!("`{key}`, none"),
        Form::Flag if key == "range" => format!("`{key} = true`, that of the joint"),
        Form::Flag => format!("`{key} = true`"),
        Form::Spin => format!("`{key}`, the joint about which the wheel turns"),
        Form::Slip => format!("`{key} = {{ stiffness, friction }}`, none"),
        _ => format!("`{key}`"),
    };
    let mut text = named;
    if !field.unit.is_empty() && field.form != Form::Point {
        text += &format!(" {}", field.unit);
    }
    if let Form::Signal(_) = field.form {
        text += ", or `table = [[time, value], ...]`";
    }
    if field.form == Form::Length {
        text += ", `\"reference\"`";
    }
    text += &match field.default {
        Default::Number(number) => format!(", {number}"),
        Default::As(other) => format!(", as `{other}`"),
        Default::Times(number, other) => format!(", {number} `{other}`"),
        Default::NeededWith(other) => format!(", needed with `{other}`"),
        Default::NeededWithout(other) => format!(", needed without `{other}`"),
        Default::Open => ", by the moved mass".to_owned(),
        Default::OpenWith(other) => format!(", by the moved mass where `{other}` is, else 0"),
        Default::Needed | Default::Nothing => String::new(),
    };
    Some(text)
}
