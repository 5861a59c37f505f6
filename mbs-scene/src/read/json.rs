//! Scenes in JSON, read into the same tree as scenes in TOML: values with their places, numbers as decimal text.

use super::tree::{Item, Member, Node, Span};
use core::fmt;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

/// Largest depth of lists and tables within each other [-]. A deeper file is a mistake or an attack. Chosen, not tuned.
const MAX_DEPTH: usize = 64;

/// Message of a syntax error, with its place.
type Fault = (String, Span);

/// The tree of a whole file, or the message and place of its first syntax error.
pub(crate) fn parse(text: &str) -> Result<Vec<Member>, Fault> {
    let reader = Reader { text };
    match reader.item(text, 0)?.node {
        Node::Table(members) => Ok(members),
        _ => Err(("a scene is an object of tables: { \"scene\": ... }".to_owned(), 0..0)),
    }
}

/// Reader of one JSON text.
struct Reader<'a> {
    text: &'a str,
}

/// The keys of an object with the text of their values, in the order of the file.
struct Pairs<'a>(Vec<(String, &'a RawValue)>);

impl<'a> Reader<'a> {
    /// The value of `part`, which is a part of the whole text.
    fn item(&self, part: &'a str, depth: usize) -> Result<Item, Fault> {
        let raw: &RawValue = self.read(part)?;
        let text = raw.get();
        let start = self.start(text);
        let span = start..start + text.len();
        if depth > MAX_DEPTH {
            return Err((format!("more than {MAX_DEPTH} lists and tables in one another"), span));
        }
        let node = match text.as_bytes().first() {
            Some(b'{') => Node::Table(self.members(text, depth)?),
            Some(b'[') => {
                let raws: Vec<&RawValue> = self.read(text)?;
                let items = raws.into_iter().map(|raw| self.item(raw.get(), depth + 1));
                Node::List(items.collect::<Result<_, _>>()?)
            }
            Some(b'"') => Node::Text(self.read(text)?),
            Some(b't' | b'f') => Node::Bool(self.read(text)?),
            Some(b'n') => {
                let message = "`null` is no value: leave the key out".to_owned();
                return Err((message, span));
            }
            _ => Node::Number(text.to_owned()),
        };
        Ok(Item { span, node })
    }

    fn members(&self, text: &'a str, depth: usize) -> Result<Vec<Member>, Fault> {
        let Pairs(pairs) = self.read(text)?;
        // Byte after the opening bracket, and later after the previous value.
        let mut behind = self.start(text) + 1;
        let mut members: Vec<Member> = Vec::with_capacity(pairs.len());
        let mut keys = std::collections::HashSet::new();
        for (key, raw) in pairs {
            let item = self.item(raw.get(), depth + 1)?;
            let between = &self.text[behind..item.span.start];
            let key_start = behind + between.find('"').unwrap_or(0);
            let key_end = behind + between.rfind('"').map_or(between.len(), |i| i + 1);
            let key_span = key_start..key_end;
            behind = item.span.end;
            if !keys.insert(key.clone()) {
                return Err((format!("the key `{key}` stands here twice"), key_span));
            }
            members.push(Member { key, key_span, item });
        }
        Ok(members)
    }

    /// Byte at which a part of the whole text begins.
    fn start(&self, part: &str) -> usize {
        (part.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize)
    }

    fn read<T: Deserialize<'a>>(&self, part: &'a str) -> Result<T, Fault> {
        serde_json::from_str(part).map_err(|error| {
            let lines: usize =
                part.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
            let at = self.start(part) + lines + error.column().saturating_sub(1);
            let message = error.to_string();
            // The line and the caret show the place, so the message need not.
            let message = message.split(" at line ").next().unwrap_or_default().to_owned();
            (message, at..at)
        })
    }
}

impl<'de> Deserialize<'de> for Pairs<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Object;
        impl<'de> Visitor<'de> for Object {
            type Value = Pairs<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }
        deserializer.deserialize_map(Object)
    }
}
