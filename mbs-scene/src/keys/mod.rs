//! The keys of scene and sweep files: what may stand where, in which unit, and what it means.
//!
//! Readers check the keys of a file against these tables; the schema, `mbs kinds` and docs/SCENES.md are written from them.

mod body;
mod coupling;
mod effect;
mod example;
mod guide;
mod joint;
mod output;
mod road;
mod rolling;
mod scene;
mod signal;
mod sweep;
#[cfg(test)]
mod tests;
mod value;

pub use example::{Base, Example};
pub(crate) use output::{FORMS, ORIENTATION, of_target};
pub(crate) use road::FEATURE;
pub(crate) use scene::FILE;
pub(crate) use sweep::FILE as SWEEP_FILE;
pub use value::{Part, Value};

use mbs_core::scene::Dimension;
use std::sync::LazyLock;

/// One key of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// As it is written.
    pub name: &'static str,
    /// What stands there.
    pub value: Value,
    /// SI unit; empty: none.
    pub unit: &'static str,
    /// Must it be written?
    pub is_needed: bool,
    /// What holds where it is not written, or when it must be; empty: nothing.
    pub default: String,
    /// The scenes that have it; `None`: all.
    pub dimension: Option<Dimension>,
    /// One sentence.
    pub meaning: String,
}

/// Where a table stands in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Once in a file: `[scene]`.
    Once,
    /// In a list: `[[body]]`.
    Listed,
    /// As the value of a key: `rod = { ... }`.
    Inside,
}

/// A table of a file, of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its name.
    pub header: &'static str,
    /// The word at its key `kind`; `None`: it has no kinds.
    pub kind: Option<&'static str>,
    /// Where it stands.
    pub standing: Standing,
    /// What it is, in one or a few sentences.
    pub meaning: String,
    /// Its keys, in the order in which they are explained.
    pub keys: Vec<Key>,
    /// An example; `None` where that of another table shows it.
    pub example: Option<Example>,
}

impl Table {
    /// Its key of that name.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// As it stands in a file: `[scene]`, `[[body]]`; one that stands inside others has its name alone.
    #[must_use]
    pub fn title(&self) -> String {
        match self.standing {
            Standing::Once => format!("[{}]", self.header),
            Standing::Listed => format!("[[{}]]", self.header),
            Standing::Inside => self.header.to_owned(),
        }
    }

    /// The keys that a scene of that dimension has.
    pub(crate) fn keys_of(&self, dimension: Dimension) -> impl Iterator<Item = &Key> {
        self.keys.iter().filter(move |key| key.dimension.is_none_or(|only| only == dimension))
    }
}

/// See [`tables`].
pub(crate) static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let mut tables = [
        scene::tables(),
        body::tables(),
        joint::tables(),
        guide::tables(),
        coupling::tables(),
        rolling::tables(),
        signal::tables(),
        effect::tables(),
        road::tables(),
        scene::solver(),
        output::tables(),
        sweep::tables(),
    ]
    .concat();
    example::add(&mut tables);
    tables
});

/// All tables of scene files and of sweep files; those of one header, and of one kind, stand together.
#[must_use]
pub fn tables() -> &'static [Table] {
    &TABLES
}

/// The tables of a header, of all kinds.
pub(crate) fn of(header: &str) -> &'static [Table] {
    together(&TABLES, |table| table.header == header)
}

/// Those of a kind among the tables of a header.
pub(crate) fn of_kind(tables: &'static [Table], kind: &str) -> &'static [Table] {
    together(tables, |table| table.kind == Some(kind))
}

/// The tables of which something holds; they stand together.
pub(crate) fn together(
    tables: &'static [Table],
    is_meant: impl Fn(&Table) -> bool,
) -> &'static [Table] {
    let first = tables.iter().position(&is_meant).unwrap_or(tables.len());
    let n = tables[first..].iter().take_while(|table| is_meant(table)).count();
    &tables[first..first + n]
}

/// A key that must be written.
fn need(name: &'static str, value: Value, unit: &'static str, meaning: &str) -> Key {
    let (default, dimension) = (String::new(), None);
    Key { name, value, unit, is_needed: true, default, dimension, meaning: meaning.to_owned() }
}

/// A key that may be left out, and what holds then.
fn may(name: &'static str, value: Value, unit: &'static str, default: &str, meaning: &str) -> Key {
    Key { is_needed: false, default: default.to_owned(), ..need(name, value, unit, meaning) }
}

impl Key {
    /// The same in spatial scenes alone.
    fn in_space(self) -> Self {
        Self { dimension: Some(Dimension::Spatial), ..self }
    }

    /// The same in planar scenes alone.
    fn in_the_plane(self) -> Self {
        Self { dimension: Some(Dimension::Planar), ..self }
    }
}

/// A table that stands in a list.
fn listed(header: &'static str, meaning: &str, keys: Vec<Key>) -> Table {
    let (kind, standing, example) = (None, Standing::Listed, None);
    Table { header, kind, standing, meaning: meaning.to_owned(), keys, example }
}

/// A table that stands once in a file.
fn once(header: &'static str, meaning: &str, keys: Vec<Key>) -> Table {
    Table { standing: Standing::Once, ..listed(header, meaning, keys) }
}

/// A table that is the value of a key.
fn inside(header: &'static str, meaning: &str, keys: Vec<Key>) -> Table {
    Table { standing: Standing::Inside, ..listed(header, meaning, keys) }
}

/// Tables of a header with kinds: each has the key `kind`, and those that all have, before its own.
fn kinds<const N: usize>(
    header: &'static str,
    common: &[Key],
    kinds: [(&'static str, Table); N],
) -> Vec<Table> {
    let table = |(kind, table): (&'static str, Table)| {
        let mut keys = common.to_vec();
        let first = usize::from(common.first().is_some_and(|key| key.name == "name"));
        keys.insert(first, need("kind", Value::Word(vec![kind]), "", "The kind."));
        keys.extend(table.keys);
        Table { header, kind: Some(kind), keys, ..table }
    };
    kinds.into_iter().map(table).collect()
}

/// A name that may be left out.
fn name_or(default: &str) -> Key {
    may("name", Value::Name, "", default, "Name, by which others refer to it.")
}
