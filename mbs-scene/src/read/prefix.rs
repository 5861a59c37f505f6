//! Prefixes of the names of an included file, and of the references to these names.
//!
//! The key tables of the format define where names and references occur.

use super::tree::{Item, Member, Node};
use crate::keys::{self, KeyTable, KeyValue, Referent};
use std::collections::{HashMap, HashSet};

/// A prefix, and the names of a file to which it applies.
pub(super) struct Prefix<'a> {
    prefix: &'a str,
    names: HashMap<&'static str, HashSet<String>>,
}

/// Kinds of parts that other parts refer to by name.
const PARTS: [Referent; 7] = [
    Referent::Body,
    Referent::Joint,
    Referent::Coupling,
    Referent::Rolling,
    Referent::Signal,
    Referent::Effect,
    Referent::Point,
];

impl<'a> Prefix<'a> {
    /// The names of the tree `root`, with the prefix for them.
    pub(super) fn new(prefix: &'a str, root: &[Member]) -> Self {
        let of_list = |header: &str, key: &str| {
            let list = root.iter().find(|member| member.key == header);
            let Some(Item { node: Node::List(items), .. }) = list.map(|member| &member.item) else {
                return Vec::new();
            };
            items.iter().filter_map(|item| item.text_at(key).map(str::to_owned)).collect()
        };
        let names = PARTS.map(|part| {
            let mut names: HashSet<String> = of_list(part.name(), "name").into_iter().collect();
            if part == Referent::Joint {
                // The joint of a guided body has the body's name.
                names.extend(of_list("guide", "body"));
            }
            if part == Referent::Body {
                // The name of a frame is allowed wherever that of a body is.
                names.extend(of_list("frame", "name"));
            }
            (part.name(), names)
        });
        Self { prefix, names: names.into() }
    }

    /// Adds the prefix to the names of a tree, to the references to them, and to the names of its parameters.
    pub(super) fn put(&self, root: &mut [Member]) {
        if self.prefix.is_empty() {
            return;
        }
        for member in root {
            match &mut member.item.node {
                Node::List(items) => {
                    let tables = keys::of(&member.key);
                    items.iter_mut().for_each(|item| self.entry(item, tables));
                }
                Node::Table(parameters) => {
                    parameters.iter_mut().for_each(|member| self.name(&mut member.key));
                }
                _ => {}
            }
        }
    }

    fn name(&self, name: &mut String) {
        name.insert_str(0, self.prefix);
    }

    /// Adds the prefix within a table that has one of these key tables.
    fn entry(&self, item: &mut Item, tables: &'static [KeyTable]) {
        let of_kind = item.text_at("kind").map_or(&[][..], |kind| keys::of_kind(tables, kind));
        let tables = if of_kind.is_empty() { tables } else { of_kind };
        let Node::Table(members) = &mut item.node else { return };
        for Member { key, item, .. } in members {
            // A key that differs between planar and spatial scenes has the same names in both.
            if let Some(key) = tables.iter().find_map(|table| table.key(key)) {
                self.value(item, &key.value);
            }
        }
    }

    fn value(&self, item: &mut Item, value: &KeyValue) {
        match value {
            KeyValue::Name => {
                if let Node::Text(name) = &mut item.node {
                    self.name(name);
                }
            }
            KeyValue::Of(part)
            | KeyValue::Several(part, _)
            | KeyValue::Some(part)
            | KeyValue::OneOrSome(part) => self.references(item, *part),
            KeyValue::OfOr(part, words) => {
                let is_word =
                    matches!(&item.node, Node::Text(text) if words.contains(&text.as_str()));
                if !is_word {
                    self.references(item, *part);
                }
            }
            KeyValue::SomePlaces => self.places(item, &KeyValue::Places(0)),
            KeyValue::Place | KeyValue::Places(_) | KeyValue::Vector | KeyValue::Vectors(_) => {
                self.places(item, value);
            }
            KeyValue::NumberOrVector => self.places(item, &KeyValue::Vector),
            KeyValue::Table(header)
            | KeyValue::Tables(header)
            | KeyValue::TableOrTables(header) => {
                self.tables(item, header);
            }
            KeyValue::PlacesOrTables(header) => {
                let Node::List(items) = &mut item.node else { return };
                for item in items {
                    // A place relative to a point is a table too.
                    match (&item.node, item.get("of")) {
                        (Node::Table(_), None) => self.tables(item, header),
                        _ => self.places(item, &KeyValue::Place),
                    }
                }
            }
            _ => {}
        }
    }

    /// Adds the prefix to one reference or to a list of references. A name that the included file does not have remains unchanged.
    fn references(&self, item: &mut Item, part: Referent) {
        match &mut item.node {
            Node::Text(name) if self.names[part.name()].contains(name) => self.name(name),
            Node::List(items) => items.iter_mut().for_each(|item| self.references(item, part)),
            _ => {}
        }
    }

    fn tables(&self, item: &mut Item, header: &str) {
        match &mut item.node {
            Node::List(items) => items.iter_mut().for_each(|item| self.tables(item, header)),
            _ => self.entry(item, keys::of(header)),
        }
    }

    /// Adds the prefix to the names of points in a place, in a vector, or in a list of them.
    fn places(&self, item: &mut Item, value: &KeyValue) {
        match (value, &mut item.node) {
            (KeyValue::Places(_), Node::List(items)) => {
                items.iter_mut().for_each(|item| self.places(item, &KeyValue::Place));
            }
            (KeyValue::Vectors(_), Node::List(items)) => {
                items.iter_mut().for_each(|item| self.places(item, &KeyValue::Vector));
            }
            (KeyValue::Place, Node::Text(_)) => self.references(item, Referent::Point),
            (KeyValue::Place, Node::Table(_)) => self.tables(item, keys::PLACE),
            (KeyValue::Vector, Node::Table(_)) => self.tables(item, keys::DIRECTION),
            _ => {}
        }
    }
}
