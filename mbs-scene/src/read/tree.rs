//! The syntax tree of a file: every value with its bytes, numbers as decimal text, keys in the order of the file.

use core::ops::Range;
use toml::de::{DeInteger, DeTable, DeValue};

/// Range of bytes in the texts of a scene.
pub(crate) type Span = Range<usize>;

/// A value, with its bytes in the file.
#[derive(Debug, Clone)]
pub(crate) struct Item {
    pub(crate) span: Span,
    pub(crate) node: Node,
}

/// Content of a value, as it is written in the file.
#[derive(Debug, Clone)]
pub(crate) enum Node {
    Text(String),
    /// Decimal text of a number, without underscores.
    Number(String),
    Bool(bool),
    Date,
    List(Vec<Item>),
    Table(Vec<Member>),
}

/// A key with its value.
#[derive(Debug, Clone)]
pub(crate) struct Member {
    pub(crate) key: String,
    pub(crate) key_span: Span,
    pub(crate) item: Item,
}

/// The value of a key, among the keys of a table.
pub(crate) fn find<'a>(members: &'a [Member], key: &str) -> Option<&'a Item> {
    members.iter().find(|member| member.key == key).map(|member| &member.item)
}

impl Member {
    /// Maps all byte positions of the key and of its value by `moved`.
    pub(crate) fn move_spans(&mut self, moved: &impl Fn(usize) -> usize) {
        self.key_span = moved(self.key_span.start)..moved(self.key_span.end);
        self.item.move_spans(moved);
    }
}

impl Item {
    /// The value of a key, if the item is a table.
    pub(crate) fn get(&self, key: &str) -> Option<&Self> {
        let Node::Table(members) = &self.node else { return None };
        find(members, key)
    }

    /// The text at a key, if the item is a table and the value is a text.
    pub(crate) fn text_at(&self, key: &str) -> Option<&str> {
        match &self.get(key)?.node {
            Node::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Maps all byte positions of the item and of its parts by `moved`.
    pub(crate) fn move_spans(&mut self, moved: &impl Fn(usize) -> usize) {
        self.span = moved(self.span.start)..moved(self.span.end);
        match &mut self.node {
            Node::List(items) => items.iter_mut().for_each(|item| item.move_spans(moved)),
            Node::Table(members) => {
                members.iter_mut().for_each(|member| member.move_spans(moved));
            }
            Node::Text(_) | Node::Number(_) | Node::Bool(_) | Node::Date => {}
        }
    }
}

impl Node {
    /// Description of the type of the value, for messages.
    pub(crate) fn description(&self) -> &'static str {
        match self {
            Self::Text(_) => "a text",
            Self::Number(_) => "a number",
            Self::Bool(_) => "true or false",
            Self::Date => "a date",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
        }
    }
}

/// The tree of a whole file, or the message and place of its first syntax error.
pub(crate) fn parse(text: &str) -> Result<Vec<Member>, (String, Span)> {
    match DeTable::parse(text) {
        Ok(root) => Ok(members(root.get_ref())),
        Err(error) => Err((error.message().to_owned(), error.span().unwrap_or(0..0))),
    }
}

fn members(table: &DeTable<'_>) -> Vec<Member> {
    let mut members: Vec<Member> = table
        .iter()
        .map(|(key, value)| Member {
            key: key.get_ref().clone().into_owned(),
            key_span: key.span(),
            item: item(value.get_ref(), value.span()),
        })
        .collect();
    // The parser sorts keys by name, but messages report the first fault in the file.
    members.sort_by_key(|member| member.key_span.start);
    members
}

fn item(value: &DeValue<'_>, span: Span) -> Item {
    let node = match value {
        DeValue::String(text) => Node::Text(text.clone().into_owned()),
        DeValue::Integer(number) => Node::Number(decimal(number)),
        DeValue::Float(number) => Node::Number(number.as_str().to_owned()),
        DeValue::Boolean(flag) => Node::Bool(*flag),
        DeValue::Datetime(_) => Node::Date,
        DeValue::Array(array) => {
            Node::List(array.iter().map(|entry| item(entry.get_ref(), entry.span())).collect())
        }
        DeValue::Table(table) => Node::Table(members(table)),
    };
    Item { span, node }
}

/// Decimal text of a whole number. Hexadecimal and binary numbers beyond 128 bits keep their text, and are refused as numbers later.
fn decimal(number: &DeInteger<'_>) -> String {
    if number.radix() == 10 {
        return number.as_str().to_owned();
    }
    match u128::from_str_radix(number.as_str(), number.radix()) {
        Ok(value) => value.to_string(),
        Err(_) => number.to_string(),
    }
}
