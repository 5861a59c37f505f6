//! Reader of TOML: plain values, and tables whose keys are removed as they are read.

use crate::vector::{Vector, ZERO};
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue};

/// Reason why a scene cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault(pub String);

/// A result of reading.
pub(crate) type Read<T> = Result<T, Fault>;

/// Value in a scene file.
#[derive(Debug, Clone)]
pub(crate) enum Node {
    Number(f64),
    Text(String),
    Flag(bool),
    List(Vec<Self>),
    Table(Table),
}

/// Table of a scene file. A key that is read is removed, so that unknown keys remain.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    entries: BTreeMap<String, Node>,
    pub(crate) planar: bool,
}

pub(crate) fn fault<T>(why: impl Into<String>) -> Read<T> {
    Err(Fault(why.into()))
}

/// Reads the text of a TOML file.
pub(crate) fn parse(text: &str) -> Read<Table> {
    let table = DeTable::parse(text).map_err(|e| Fault(e.to_string()))?;
    Ok(convert(table.get_ref()))
}

fn convert(table: &DeTable<'_>) -> Table {
    let entries = table
        .iter()
        .map(|(key, value)| (key.get_ref().to_string(), node(value.get_ref())))
        .collect();
    Table { entries, planar: false }
}

fn node(value: &DeValue<'_>) -> Node {
    let number = |text: &str| {
        text.replace('_', "").parse().map_or(Node::Text(text.to_owned()), Node::Number)
    };
    match value {
        DeValue::String(text) => Node::Text(text.to_string()),
        DeValue::Integer(n) => number(n.as_str()),
        DeValue::Float(n) => number(n.as_str()),
        DeValue::Boolean(flag) => Node::Flag(*flag),
        DeValue::Datetime(date) => Node::Text(date.to_string()),
        DeValue::Array(list) => Node::List(list.iter().map(|v| node(v.get_ref())).collect()),
        DeValue::Table(table) => Node::Table(convert(table)),
    }
}

impl Node {
    pub(crate) fn number(&self) -> Read<f64> {
        match self {
            Self::Number(x) if x.is_finite() => Ok(*x),
            other => fault(format!("not a number: {other:?}")),
        }
    }

    pub(crate) fn list(&self) -> Read<&[Self]> {
        match self {
            Self::List(list) => Ok(list),
            other => fault(format!("not a list: {other:?}")),
        }
    }

    /// One number, or a list of numbers.
    pub(crate) fn numbers(&self) -> Read<Vec<f64>> {
        match self {
            Self::List(list) => list.iter().map(Self::number).collect(),
            one => Ok(vec![one.number()?]),
        }
    }

    pub(crate) fn vector(&self, planar: bool) -> Read<Vector> {
        match (self.numbers()?.as_slice(), planar) {
            (&[x, y], true) => Ok([x, y, 0.0]),
            (&[x, y, z], false) => Ok([x, y, z]),
            (other, _) => fault(format!("not a vector: {other:?}")),
        }
    }
}

impl Table {
    pub(crate) fn take(&mut self, key: &str) -> Option<Node> {
        self.entries.remove(key)
    }

    pub(crate) fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    pub(crate) fn need(&mut self, key: &str) -> Read<Node> {
        self.take(key).map_or_else(|| fault(format!("`{key}` is missing")), Ok)
    }

    pub(crate) fn text(&mut self, key: &str) -> Read<String> {
        match self.need(key)? {
            Node::Text(text) => Ok(text),
            other => fault(format!("`{key}` is not a text: {other:?}")),
        }
    }

    pub(crate) fn number(&mut self, key: &str) -> Read<f64> {
        self.need(key)?.number()
    }

    pub(crate) fn number_or(&mut self, key: &str, default: f64) -> Read<f64> {
        self.take(key).map_or(Ok(default), |node| node.number())
    }

    pub(crate) fn vector(&mut self, key: &str) -> Read<Vector> {
        let planar = self.planar;
        self.need(key)?.vector(planar)
    }

    pub(crate) fn vector_or_none(&mut self, key: &str) -> Read<Option<Vector>> {
        let planar = self.planar;
        self.take(key).map(|node| node.vector(planar)).transpose()
    }

    pub(crate) fn two_vectors(&mut self, key: &str) -> Read<[Vector; 2]> {
        let planar = self.planar;
        match self.need(key)?.list()? {
            [a, b] => Ok([a.vector(planar)?, b.vector(planar)?]),
            _ => fault(format!("`{key}` is not a pair")),
        }
    }

    /// A list of exactly N numbers.
    pub(crate) fn exactly<const N: usize>(&mut self, key: &str) -> Read<[f64; N]> {
        let numbers = self.need(key)?.numbers()?;
        <[f64; N]>::try_from(numbers).map_or_else(|_| fault(format!("`{key}`: {N} numbers")), Ok)
    }

    /// The tables of a list, in the order of the file.
    pub(crate) fn tables(&mut self, key: &str) -> Read<Vec<Self>> {
        let list = match self.take(key) {
            None => return Ok(Vec::new()),
            Some(Node::List(list)) => list,
            Some(one) => vec![one],
        };
        list.into_iter()
            .map(|node| match node {
                Node::Table(table) => Ok(Self { planar: self.planar, ..table }),
                other => fault(format!("`{key}`: not a table: {other:?}")),
            })
            .collect()
    }

    /// A table of a key.
    pub(crate) fn table(&mut self, key: &str) -> Read<Option<Self>> {
        Ok(self.tables(key)?.pop())
    }

    /// Reads `value`, a number or a vector, or `table`, whose rows have a time and a number or vector.
    pub(crate) fn signal(&mut self, vectors: bool) -> Read<Vec<(f64, Vector)>> {
        let planar = self.planar;
        let read = |numbers: &[f64]| match (vectors, numbers) {
            (false, &[x]) => Ok([x, 0.0, 0.0]),
            (true, &[x, y]) if planar => Ok([x, y, 0.0]),
            (true, &[x, y, z]) if !planar => Ok([x, y, z]),
            _ => fault(format!("not a value: {numbers:?}")),
        };
        if let Some(value) = self.take("value") {
            return Ok(vec![(0.0, read(&value.numbers()?)?)]);
        }
        let table = self.need("table")?;
        let rows = table.list()?.iter().map(|row| {
            let row = row.list()?;
            let [time, rest @ ..] = row else { return fault("an empty row") };
            let flat: Vec<Vec<f64>> = rest.iter().map(Node::numbers).collect::<Read<_>>()?;
            Ok((time.number()?, read(&flat.concat())?))
        });
        let rows: Vec<(f64, Vector)> = rows.collect::<Read<_>>()?;
        if rows.is_empty() { Ok(vec![(0.0, ZERO)]) } else { Ok(rows) }
    }

    /// Refuses a table in which keys are left that were not read, since they are unknown.
    pub(crate) fn done(self, of: &str) -> Read<()> {
        match self.entries.keys().next() {
            None => Ok(()),
            Some(key) => fault(format!("{of}: `{key}` is not known")),
        }
    }
}
