//! Tables of keys, and what makes them.

use super::example::Example;
use super::value::KeyValue;
use mbs_core::scene::Dimension;

/// One key of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Name of the key, as it is written.
    pub name: &'static str,
    /// Form of the value at the key.
    pub value: KeyValue,
    /// SI unit of the value; empty: none.
    pub unit: &'static str,
    /// Must it be written?
    pub is_needed: bool,
    /// Default where the key is not written, or the case in which it must be; empty: nothing.
    pub default: String,
    /// The scenes that have it; `None`: all.
    pub dimension: Option<Dimension>,
    /// Meaning of the key, in one sentence.
    pub meaning: String,
}

/// Standing of a table in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Once in a file: `[scene]`.
    Once,
    /// In a list of tables: `[[body]]`.
    Listed,
    /// Inside another table, as the value of a key: `rod = { ... }`.
    Inside,
}

/// A table of a file, of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyTable {
    /// Name of the table.
    pub header: &'static str,
    /// The word at its key `kind`; `None`: it has no kinds.
    pub kind: Option<&'static str>,
    /// Standing of the table in a file.
    pub standing: Standing,
    /// Meaning of the table, in one or a few sentences.
    pub meaning: String,
    /// The law of an effect, and its range; empty: it has none.
    pub law: &'static str,
    /// Keys of the table, in the order in which they are explained.
    pub keys: Vec<Key>,
    /// Example of the table; `None` where that of another table shows it.
    pub example: Option<Example>,
}

impl KeyTable {
    /// Returns the key of that name.
    #[must_use]
    pub fn key(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// Title of the table, as it stands in a file: `[scene]`, `[[body]]`; one that stands inside others has its name alone.
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

/// A key that must be written.
pub(super) fn need(name: &'static str, value: KeyValue, unit: &'static str, meaning: &str) -> Key {
    let (default, dimension) = (String::new(), None);
    Key { name, value, unit, is_needed: true, default, dimension, meaning: meaning.to_owned() }
}

/// A key that may be left out, and what holds then.
pub(super) fn may(
    name: &'static str,
    value: KeyValue,
    unit: &'static str,
    default: &str,
    meaning: &str,
) -> Key {
    Key { is_needed: false, default: default.to_owned(), ..need(name, value, unit, meaning) }
}

impl Key {
    /// Returns the key for spatial scenes alone.
    pub(super) fn in_space(self) -> Self {
        Self { dimension: Some(Dimension::Spatial), ..self }
    }

    /// Returns the key for planar scenes alone.
    pub(super) fn in_the_plane(self) -> Self {
        Self { dimension: Some(Dimension::Planar), ..self }
    }
}

/// A table that stands in a list.
pub(super) fn listed(header: &'static str, meaning: &str, keys: Vec<Key>) -> KeyTable {
    let (kind, standing, law, example) = (None, Standing::Listed, "", None);
    KeyTable { header, kind, standing, meaning: meaning.to_owned(), law, keys, example }
}

/// A table that stands once in a file.
pub(super) fn once(header: &'static str, meaning: &str, keys: Vec<Key>) -> KeyTable {
    KeyTable { standing: Standing::Once, ..listed(header, meaning, keys) }
}

/// A table that is the value of a key.
pub(super) fn inside(header: &'static str, meaning: &str, keys: Vec<Key>) -> KeyTable {
    KeyTable { standing: Standing::Inside, ..listed(header, meaning, keys) }
}

/// Tables of a header with kinds: each has the key `kind`, and those that all have, before its own.
pub(super) fn kinds<const N: usize>(
    header: &'static str,
    common: &[Key],
    kinds: [(&'static str, KeyTable); N],
) -> Vec<KeyTable> {
    let table = |(kind, table): (&'static str, KeyTable)| {
        let mut keys = common.to_vec();
        let first = usize::from(common.first().is_some_and(|key| key.name == "name"));
        keys.insert(first, need("kind", KeyValue::Word(vec![kind]), "", "The kind."));
        keys.extend(table.keys);
        KeyTable { header, kind: Some(kind), keys, ..table }
    };
    kinds.into_iter().map(table).collect()
}

/// A name that may be left out.
pub(super) fn name_or(default: &str) -> Key {
    may("name", KeyValue::Name, "", default, "Name, by which others refer to it.")
}
