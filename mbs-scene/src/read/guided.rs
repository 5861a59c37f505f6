//! Entries `[[guide]]` of a file, with the guides and joints of the scene that each makes.
//!
//! An entry with `signals` makes one guide for each signal. An entry with `body` also makes a free joint; these joints come after those of
//! the file.

use crate::read::ReadFault;
use crate::read::document::SceneFile;
use crate::read::fields::Read;
use crate::read::tree::{Item, Node};
use mbs_core::scene::{Entry, SceneError, SceneFault};

impl SceneFile {
    /// The entries of a list of tables.
    pub(crate) fn listed(&self, table: &str) -> &[Item] {
        match self.top(table) {
            Some(Item { node: Node::List(items), .. }) => items,
            _ => &[],
        }
    }

    /// The entry that makes a guide, as its index in the file, and the index of the guide among the guides of that entry.
    pub(crate) fn entry_of_guide(&self, guide: usize) -> Option<(usize, usize)> {
        let mut first = 0;
        for (i, entry) in self.listed("guide").iter().enumerate() {
            let n = n_guides(entry);
            if guide < first + n {
                return Some((i, guide - first));
            }
            first += n;
        }
        None
    }

    /// The place of the value of a guide's key, or of the guide's entry when the key is not written. The key `signal` refers to one of the
    /// list `signals`. The key `joint` may be written as `body`.
    pub(crate) fn item_of_guide(&self, guide: usize, field: &str) -> Option<&Item> {
        let (entry, number) = self.entry_of_guide(guide)?;
        let entry = self.listed("guide").get(entry)?;
        let found = match (field, entry.get("signals")) {
            ("signal", Some(Item { node: Node::List(signals), .. })) => signals.get(number),
            ("joint", _) => entry.get("joint").or_else(|| entry.get("body")),
            _ => entry.get(field),
        };
        found.or(Some(entry))
    }

    /// The place of a joint's key. The joint is written in the file, or it belongs to a guided body.
    pub(crate) fn item_of_joint(&self, joint: usize, field: &str) -> Option<&Item> {
        let joints = self.listed("joint");
        let Some(entry) = joints.get(joint) else {
            let mut bodies =
                self.listed("guide").iter().filter(|entry| entry.get("body").is_some());
            let entry = bodies.nth(joint - joints.len())?;
            return entry.get(field).or_else(|| entry.get("body"));
        };
        entry.get(field).or(Some(entry))
    }

    /// The names of the guided bodies, which are also the names of their joints.
    ///
    /// # Errors
    /// An error for a body that is guided twice.
    pub(crate) fn guided_bodies(&self) -> Read<Vec<String>> {
        let (mut names, mut guide) = (Vec::<(String, usize)>::new(), 0);
        for entry in self.listed("guide") {
            let first = guide;
            guide += n_guides(entry);
            let Some(body) = entry.get("body") else { continue };
            // A value that is not a text is refused when the entry is read.
            let name = if let Node::Text(name) = &body.node { name.as_str() } else { "" };
            let twice = names.iter().find(|(other, _)| !name.is_empty() && other == name);
            if let Some(&(_, other)) = twice {
                let (entry, fault) = (Entry::Guide(first), SceneFault::GivenTwice(other));
                return Err(self.meaning(SceneError { entry, field: "body", fault }));
            }
            let is =
                |table: &str| self.listed(table).iter().any(|x| x.text_at("name") == Some(name));
            if is("joint") && !is("body") {
                let fault = ReadFault::GuidedJoint { name: name.to_owned() };
                return Err(self.texts.error(&body.span, fault));
            }
            names.push((name.to_owned(), first));
        }
        Ok(names.into_iter().map(|(name, _)| name).collect())
    }
}

/// Number of guides that an entry makes.
fn n_guides(entry: &Item) -> usize {
    match entry.get("signals") {
        Some(Item { node: Node::List(signals), .. }) => signals.len(),
        _ => 1,
    }
}
