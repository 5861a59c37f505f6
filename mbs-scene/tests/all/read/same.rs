//! Scenes of the repository in other notations: the numbers are equal in all digits.

use super::*;
use std::fmt::Write;
use std::path::PathBuf;
use toml::de::{DeTable, DeValue};

fn scenes() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes"))
}

/// Writes a TOML value as JSON, with the decimal texts of its numbers.
fn json(value: &DeValue<'_>, out: &mut String) {
    let text = |text: &str| serde_json::Value::from(text).to_string();
    match value {
        DeValue::String(word) => *out += &text(word),
        DeValue::Integer(number) => {
            assert_eq!(number.radix(), 10);
            *out += number.as_str().trim_start_matches('+');
        }
        DeValue::Float(number) => *out += number.as_str().trim_start_matches('+'),
        DeValue::Boolean(flag) => write!(out, "{flag}").expect("a string"),
        DeValue::Datetime(_) => panic!("no key of a scene is a date"),
        DeValue::Array(items) => {
            *out += "[";
            for (i, item) in items.iter().enumerate() {
                *out += if i > 0 { ",\n" } else { "" };
                json(item.get_ref(), out);
            }
            *out += "]";
        }
        DeValue::Table(table) => object(table, out),
    }
}

/// Writes a table as a JSON object, with its keys in the order of the file.
fn object(table: &DeTable<'_>, out: &mut String) {
    let mut members: Vec<_> = table.iter().collect();
    members.sort_by_key(|(key, _)| key.span().start);
    *out += "{";
    for (i, (key, value)) in members.into_iter().enumerate() {
        let name = serde_json::Value::from(key.get_ref().as_ref());
        write!(out, "{}{name}: ", if i > 0 { ", " } else { "" }).expect("a string");
        json(value.get_ref(), out);
    }
    *out += "}";
}

#[test]
fn every_scene_in_json_is_that_in_toml() {
    let mut n = 0;
    for entry in std::fs::read_dir(scenes()).expect("the scenes") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let file = SceneFile::read(&path).unwrap_or_else(|e| panic!("{}", e.render()));
        let toml = std::fs::read_to_string(&path).expect("a scene");
        let mut text = String::new();
        object(DeTable::parse(&toml).expect("TOML").get_ref(), &mut text);
        let name = path.with_extension("json").display().to_string();
        let of_json = SceneFile::parse(&text, &name).unwrap_or_else(|e| panic!("{}", e.render()));
        assert_eq!(of_json.numbers().expect("a scene"), file.numbers().expect("a scene"), "{name}");
        n += 1;
    }
    assert!(n > 40, "{n} scenes");
}

#[test]
fn the_iltis_of_points_and_parts_is_the_one_written_out() {
    let [parts, whole] = ["parts/iltis-stairs.toml", "iltis-stairs.toml"].map(|name| {
        let file =
            SceneFile::read(scenes().join(name)).unwrap_or_else(|e| panic!("{}", e.render()));
        file.numbers().unwrap_or_else(|e| panic!("{}", e.render()))
    });
    let renamed = |name: &mut String| {
        if let Some((corner, part)) = name.split_once(' ') {
            *name = format!("{part}-{corner}");
        }
    };
    let mut parts = parts;
    parts.bodies.iter_mut().for_each(|body| renamed(&mut body.name));
    parts.joints.iter_mut().for_each(|joint| renamed(&mut joint.name));
    parts.effects.iter_mut().for_each(|effect| renamed(&mut effect.name));
    assert_eq!(parts, whole);
    let lines =
        |name: &str| std::fs::read_to_string(scenes().join(name)).map(|text| text.lines().count());
    let both = lines("parts/iltis-stairs.toml").expect("a file")
        + lines("parts/iltis-corner.toml").expect("a file");
    assert!(both <= 200, "{both} lines");
}
