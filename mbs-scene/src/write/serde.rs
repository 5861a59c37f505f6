//! Scene files as data of serde: tables and keys as in the scene format.
//!
//! A number is an `f64` when its shortest text is the written text. Otherwise it is `{ "decimal": "..." }`, which keeps all digits.

use crate::read::SceneFile;
use crate::read::tree::{Item, Member, Node};
use crate::write::toml;
use core::fmt;
use mbs_core::scene::Number;
use serde::de::{Error, MapAccess, SeqAccess, Visitor};
use serde::ser::{SerializeMap, SerializeSeq};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Key of a number that is stored as decimal text.
const DECIMAL: &str = "decimal";

impl Serialize for SceneFile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        members(self.root(), serializer)
    }
}

fn members<S: Serializer>(members: &[Member], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(members.len()))?;
    for Member { key, item, .. } in members {
        map.serialize_entry(key, &Value(item))?;
    }
    map.end()
}

struct Value<'a>(&'a Item);

impl Serialize for Value<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0.node {
            Node::Text(text) => serializer.serialize_str(text),
            Node::Number(text) => match (text.parse::<i64>(), Number::from_decimal(text)) {
                // A whole number, such as a count or a dimension, is not a float.
                (Ok(whole), _) => serializer.serialize_i64(whole),
                (_, Some(x)) if Number::from(x.to_f64()) == x => {
                    serializer.serialize_f64(x.to_f64())
                }
                _ => {
                    let mut map = serializer.serialize_map(Some(1))?;
                    map.serialize_entry(DECIMAL, text)?;
                    map.end()
                }
            },
            Node::Bool(flag) => serializer.serialize_bool(*flag),
            // No key of a scene is a date, so the text is not used.
            Node::Date => serializer.serialize_str(""),
            Node::List(items) => {
                let mut list = serializer.serialize_seq(Some(items.len()))?;
                items.iter().try_for_each(|item| list.serialize_element(&Value(item)))?;
                list.end()
            }
            Node::Table(table) => members(table, serializer),
        }
    }
}

impl<'de> Deserialize<'de> for SceneFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Node::deserialize(deserializer)? {
            Node::Table(root) => {
                Self::parse(&toml::text(&root), "scene").map_err(|e| D::Error::custom(e.render()))
            }
            _ => Err(D::Error::custom("a scene is a table of tables")),
        }
    }
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Nodes)
    }
}

struct Nodes;

impl<'de> Visitor<'de> for Nodes {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a table, a list, a text, a number, or true or false")
    }

    fn visit_bool<E: Error>(self, flag: bool) -> Result<Node, E> {
        Ok(Node::Bool(flag))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Node, E> {
        Ok(Node::Number(number.to_string()))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Node, E> {
        Ok(Node::Number(number.to_string()))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Node, E> {
        let whole = number.fract() == 0.0 && number.abs() < 1e15;
        Ok(Node::Number(if whole { format!("{number}") } else { format!("{number:?}") }))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Node, E> {
        Ok(Node::Text(text.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Node, A::Error> {
        let mut items = Vec::new();
        while let Some(node) = seq.next_element()? {
            items.push(Item { span: 0..0, node });
        }
        Ok(Node::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Node, A::Error> {
        let mut members = Vec::new();
        while let Some((key, node)) = map.next_entry()? {
            members.push(Member { key, key_span: 0..0, item: Item { span: 0..0, node } });
        }
        match &members[..] {
            [Member { key, item: Item { node: Node::Text(text), .. }, .. }] if key == DECIMAL => {
                Ok(Node::Number(text.clone()))
            }
            _ => Ok(Node::Table(members)),
        }
    }
}
