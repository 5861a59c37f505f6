//! Changes of a scene file: the text gets the values of another scene, and unchanged keys and entries keep their text.

use super::toml;
use crate::read::SceneFile;
use crate::read::edit::spliced;
use crate::read::tree::{self, Item, Member, Node, Span};

impl SceneFile {
    /// The text with the values and entries of another scene, given both scenes as trees. Values may differ, and keys and entries may be new.
    /// `None` when the scenes differ in another way, for example by a removed key.
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

/// Changes of a text: replaced parts, and a tail that is added at its end.
struct Changes<'a> {
    text: &'a str,
    edits: Vec<(Span, String)>,
    tail: String,
}

impl Changes<'_> {
    fn append(&mut self, header: &str, members: &[Member]) {
        toml::table(&mut self.tail, header, members);
    }

    /// Adds the changes of the keys of one entry whose values differ.
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
            let value = toml::value(item);
            if tree::find(old, key).is_some_and(|old| toml::value(old) == value) {
                continue;
            }
            if let Some(item) = tree::find(file_keys, key) {
                self.edits.push((item.span.clone(), value));
                continue;
            }
            // A new key goes below the header.
            let rest = self.text.get(file.span.start..)?;
            let end = rest.starts_with('[').then(|| rest.find('\n').unwrap_or(rest.len()))?;
            let at = file.span.start + end;
            self.edits.push((at..at, format!("\n{key} = {value}")));
        }
        Some(())
    }
}

/// The entries of a list of tables; none when `item` is not a list.
fn entries(item: Option<&Item>) -> &[Item] {
    match item {
        Some(Item { node: Node::List(items), .. }) => items,
        _ => &[],
    }
}
