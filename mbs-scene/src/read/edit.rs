//! Numbers of a scene file by their paths: read one, replace one and keep the rest of the text.

use super::sweep::path;
use super::tree::{self, Item, Member, Node, Span};
use super::values::Values;
use super::{Place, ReadError, ReadFault, SceneFile, SweepFault};
use mbs_core::scene::Number;
use std::path::Path;

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// [`ReadFault::Unreadable`], and those of [`Self::from_bytes`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let (path, file) = (path.as_ref(), path.as_ref().display().to_string());
        match std::fs::read(path) {
            Ok(bytes) => Self::from_bytes_in(&bytes, &file, folder_of(path)),
            Err(error) => {
                let fault = ReadFault::Unreadable { problem: error.to_string() };
                Err(ReadError::new(&file, Place::of("", &(0..0)), fault))
            }
        }
    }

    /// The number that a path names, as sweeps write it: `body.upper.mass`, `joint."tie rod".points[0][2]` or `...points.0.2`.
    ///
    /// # Errors
    /// [`SweepFault`] for a path to nothing, or to something that is no number.
    pub fn number(&self, path: &str) -> Result<Number, SweepFault> {
        let address = path::address(self, path)?;
        self.number_at(&address).ok_or(SweepFault::PathSyntax("it names no finite number"))
    }

    /// The number at an address, or the value of the expression there.
    pub(super) fn number_at(&self, address: &[usize]) -> Option<Number> {
        let item = path::item(self.root(), address)?;
        match &item.node {
            Node::Number(text) => Number::from_decimal(text),
            Node::Text(text) => {
                Some(Values::new(&self.texts, &self.root).ok()?.number(text, &item.span).ok()?.0)
            }
            _ => None,
        }
    }

    /// The file with another number at a path; all else keeps its text, comments too. Where it includes others, none of the texts is
    /// changed.
    ///
    /// Cost: the text is parsed again.
    ///
    /// # Errors
    /// As [`Self::number`].
    pub fn with_number(&self, path: &str, number: &Number) -> Result<Self, SweepFault> {
        let address = path::address(self, path)?;
        if self.texts.list().len() > 1 {
            let mut file = self.clone();
            path::replace(file.root_mut(), &address, number.text());
            file.note(&format!("{path} = {number}"));
            return Ok(file);
        }
        let span = path::span(self.root(), &address).unwrap_or(0..0);
        let text = spliced(self.text(), vec![(span, number.text())]);
        let not_toml = |_| SweepFault::PathSyntax("the number is not finite");
        Self::parsed(&text, self.file(), self.folder.clone()).map_err(not_toml)
    }

    /// The text with the values and entries of another scene, by their trees; `None` where that takes more than other values of keys,
    /// further keys, and further entries.
    pub(crate) fn edited(&self, old: &[Member], new: &[Member]) -> Option<String> {
        if self.texts.list().len() > 1 {
            return None;
        }
        let mut changes = Changes { text: self.text(), edits: Vec::new(), tail: String::new() };
        if old.iter().any(|m| tree::find(new, &m.key).is_none()) {
            return None;
        }
        for Member { key, item, .. } in new {
            let pair = (tree::find(old, key), self.top(key));
            match (&item.node, pair) {
                (Node::Table(_), (Some(old), Some(file))) => changes.entry(old, item, file)?,
                (Node::Table(members), _) => changes.append(&format!("[{key}]"), members),
                (Node::List(items), pair) => {
                    let [old, file] = [pair.0, pair.1].map(entries);
                    if old.len() > items.len() {
                        return None;
                    }
                    for (i, item) in items.iter().enumerate() {
                        match (old.get(i), file.get(i), &item.node) {
                            (Some(old), Some(file), _) => changes.entry(old, item, file)?,
                            (None, None, Node::Table(m)) => {
                                changes.append(&format!("[[{key}]]"), m);
                            }
                            _ => return None,
                        }
                    }
                }
                _ => return None,
            }
        }
        let text = spliced(self.text(), changes.edits);
        Some(if changes.tail.is_empty() { text } else { format!("{text}\n{}", changes.tail) })
    }
}

/// The folder in which a file lies.
fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Changes of a text, with the tail that is added at its end.
struct Changes<'a> {
    text: &'a str,
    edits: Vec<(Span, String)>,
    tail: String,
}

impl Changes<'_> {
    fn append(&mut self, header: &str, members: &[Member]) {
        crate::write::toml::table(&mut self.tail, header, members);
    }

    /// The keys of one entry that have other values now.
    fn entry(&mut self, old: &Item, new: &Item, file: &Item) -> Option<()> {
        let (Node::Table(old), Node::Table(new), Node::Table(file_keys)) =
            (&old.node, &new.node, &file.node)
        else {
            return None;
        };
        if old.iter().any(|m| tree::find(new, &m.key).is_none()) {
            return None;
        }
        for Member { key, item, .. } in new {
            let value = crate::write::toml::value(item);
            if tree::find(old, key).is_some_and(|old| crate::write::toml::value(old) == value) {
                continue;
            }
            if let Some(item) = tree::find(file_keys, key) {
                self.edits.push((item.span.clone(), value));
                continue;
            }
            // below the header
            let rest = self.text.get(file.span.start..)?;
            let end = rest.starts_with('[').then(|| rest.find('\n').unwrap_or(rest.len()))?;
            let at = file.span.start + end;
            self.edits.push((at..at, format!("\n{key} = {value}")));
        }
        Some(())
    }
}

/// The entries of a list of tables.
fn entries(item: Option<&Item>) -> &[Item] {
    match item {
        Some(Item { node: Node::List(items), .. }) => items,
        _ => &[],
    }
}

/// A text with some of its parts replaced.
fn spliced(text: &str, mut edits: Vec<(Span, String)>) -> String {
    edits.sort_by_key(|(span, _)| span.start);
    let mut text = text.to_owned();
    for (span, new) in edits.into_iter().rev() {
        text.replace_range(span, &new);
    }
    text
}
