//! A JSON Schema of scene files, for editors and other programs. It uses the subset of draft 4 that TOML editors support.

use crate::keys::{self, FILE, Key, KeyTable, KeyValue, Referent, tables};
use serde_json::{Map, Value as Json, json};

/// The schema of a scene file. Objects are closed: keys that are not in the schema are errors.
///
/// ```
/// let schema: serde_json::Value = serde_json::from_str(&mbs_scene::manual::schema()).unwrap();
/// assert_eq!(schema["additionalProperties"], false);
/// ```
#[must_use]
pub fn schema() -> String {
    let mut schema = keys::of(FILE).first().map(of_table).unwrap_or_default();
    let mut definitions = Map::new();
    for table in tables().iter().filter(|table| table.header != FILE) {
        definitions.entry(table.header).or_insert_with(|| of_header(table.header));
    }
    if let Json::Object(schema) = &mut schema {
        schema.insert("$schema".into(), "http://json-schema.org/draft-04/schema#".into());
        schema.insert("title".into(), "mbs scene".into());
        schema.insert("definitions".into(), definitions.into());
    }
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}

/// The schema of the tables with this header. A table must match at least one of the header's key tables.
fn of_header(header: &str) -> Json {
    let tables: Vec<Json> = keys::of(header).iter().map(of_table).collect();
    match <[Json; 1]>::try_from(tables) {
        Ok([table]) => table,
        Err(tables) => json!({ "anyOf": tables }),
    }
}

fn of_table(table: &KeyTable) -> Json {
    let mut properties = Map::new();
    let mut required: Vec<&str> = Vec::new();
    for key in &table.keys {
        let others = || table.keys.iter().filter(|other| other.name == key.name);
        let forms: Vec<Json> = others().map(of_key).collect();
        // The values of a key may differ between planar and spatial scenes. The schema then allows both, since it does not know the
        // dimension.
        let form = match <[Json; 1]>::try_from(forms) {
            Ok([form]) => form,
            Err(forms) => json!({ "anyOf": forms }),
        };
        properties.insert(key.name.to_owned(), form);
        let is_needed = others().all(|other| other.is_needed)
            && (key.dimension.is_none() || others().count() > 1);
        if is_needed && !required.contains(&key.name) {
            required.push(key.name);
        }
    }
    let mut object = json!({
        "type": "object",
        "description": table.meaning,
        "properties": properties,
        "additionalProperties": false,
    });
    if !required.is_empty() {
        object["required"] = required.into();
    }
    object
}

fn of_key(key: &Key) -> Json {
    let mut form = of_value(&key.value);
    let unit = if key.unit.is_empty() { String::new() } else { format!(" [{}]", key.unit) };
    let description = format!("{}{unit}", key.meaning);
    if let Json::Object(form) = &mut form {
        form.insert("description".into(), description.into());
        // A default is added only if it is a value. Some defaults are an explanation.
        if let Ok(default @ (Json::Number(_) | Json::Bool(_))) = serde_json::from_str(&key.default)
        {
            form.insert("default".into(), default);
        }
    }
    form
}

fn of_value(value: &KeyValue) -> Json {
    let list = |of: Json, n: Option<usize>| match n {
        Some(n) => json!({ "type": "array", "items": of, "minItems": n, "maxItems": n }),
        None => json!({ "type": "array", "items": of }),
    };
    let text = || json!({ "type": "string" });
    // A number may be written as a text, since a text may be an expression.
    let number = || json!({ "type": ["number", "string"] });
    let count = || json!({ "type": "integer", "minimum": 1 });
    let any_of = |forms: Vec<Json>| json!({ "anyOf": forms });
    let table =
        |header: &str| json!({ "$ref": format!("#/definitions/{}", header.replace(' ', "%20")) });
    let numbers = || json!({ "type": "array", "items": number(), "minItems": 2, "maxItems": 3 });
    let vector = || any_of(vec![numbers(), table(keys::DIRECTION)]);
    let place = || any_of(vec![numbers(), text(), table(keys::PLACE)]);
    let rows = || list(json!({ "type": "array", "items": any_of(vec![number(), vector()]) }), None);
    let name = |part: &Referent| match part {
        Referent::MovingBody => json!({ "type": "string", "not": { "enum": ["ground"] } }),
        _ => text(),
    };
    match value {
        KeyValue::Name | KeyValue::Text | KeyValue::Path => text(),
        KeyValue::Number => number(),
        KeyValue::NumberOr(words) => any_of(vec![number(), json!({ "enum": words })]),
        KeyValue::Count => count(),
        KeyValue::Counts(n) => list(count(), Some(*n)),
        KeyValue::Flag => json!({ "type": "boolean" }),
        KeyValue::Word(words) if words.iter().all(|word| word.parse::<u32>().is_ok()) => {
            let numbers: Vec<u32> = words.iter().filter_map(|word| word.parse().ok()).collect();
            json!({ "enum": numbers })
        }
        KeyValue::Word(words) => json!({ "enum": words }),
        KeyValue::Coordinate => any_of(vec![text(), json!({ "type": "integer", "minimum": 0 })]),
        KeyValue::Vector => vector(),
        KeyValue::Place => place(),
        KeyValue::Vectors(n) => list(vector(), Some(*n)),
        KeyValue::Places(n) => list(place(), Some(*n)),
        KeyValue::NumberOrVector => any_of(vec![number(), vector()]),
        KeyValue::SomePlaces => list(place(), None),
        KeyValue::Numbers(n) => list(number(), Some(*n)),
        KeyValue::SomeNumbers => any_of(vec![number(), list(number(), None)]),
        KeyValue::Texts => list(text(), None),
        KeyValue::Rows => rows(),
        KeyValue::RowsOrFile => any_of(vec![rows(), table(keys::TABLE_FILE)]),
        KeyValue::Of(part) | KeyValue::OfOr(part, _) => name(part),
        KeyValue::Several(part, n) => list(name(part), Some(*n)),
        KeyValue::Some(part) => list(name(part), None),
        KeyValue::OneOrSome(part) => any_of(vec![name(part), list(name(part), None)]),
        KeyValue::Table(header) => table(header),
        KeyValue::Tables(header) => list(table(header), None),
        KeyValue::TableOrTables(header) => any_of(vec![table(header), list(table(header), None)]),
        KeyValue::PlacesOrTables(header) => {
            any_of(vec![list(place(), Some(2)), list(table(header), None)])
        }
        KeyValue::Parameters => json!({ "type": "object", "additionalProperties": number() }),
        KeyValue::PathOrPaths => any_of(vec![text(), list(text(), None)]),
    }
}
