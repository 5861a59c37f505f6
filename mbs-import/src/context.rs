//! Data that the parts of a format's reader have in common.

use crate::findings::Findings;
use crate::options::ImportOptions;
use crate::source::{Fault, Origin, Read, Sources};
use mbs_scene::nearest_name;
use std::collections::HashMap;

/// Texts, findings and options of a reader.
#[derive(Debug)]
pub(crate) struct Context<'a> {
    pub(crate) sources: Sources,
    pub(crate) findings: Findings,
    pub(crate) options: &'a ImportOptions,
}

/// Named parts of one kind, with their indices.
#[derive(Debug)]
pub(crate) struct Named {
    /// Kind of the parts, such as `link`.
    what: &'static str,
    first: usize,
    by_name: HashMap<String, (usize, Origin)>,
    names: Vec<String>,
}

impl Named {
    /// Returns an empty list whose first part will get the index `first`.
    pub(crate) fn new(what: &'static str, first: usize) -> Self {
        Self { what, first, by_name: HashMap::new(), names: Vec::new() }
    }

    /// Adds the next part and returns its index. A name that the list already has is an error.
    pub(crate) fn add(&mut self, name: &str, at: Origin, sources: &Sources) -> Read<usize> {
        let number = self.first + self.names.len();
        if let Some((_, first)) = self.by_name.insert(name.to_owned(), (number, at)) {
            let line = sources.place(first).line;
            let message = format!("a second {} `{name}`", self.what);
            let hint = format!(
                "the first one is at {}:{line}: give one of them another name",
                sources.name(first)
            );
            return Err(Fault::new(at, message, hint));
        }
        self.names.push(name.to_owned());
        Ok(number)
    }

    /// The index of the part with this name; an unknown name is an error at the place `at`.
    pub(crate) fn find(&self, name: &str, at: Origin) -> Read<usize> {
        self.get(name).ok_or_else(|| {
            let hint = nearest_name(name, &self.names, &format!("{}s", self.what));
            Fault::new(at, format!("unknown {} `{name}`", self.what), hint)
        })
    }

    /// The index of the copy of a part: its name is `name` with this ending. If there is no copy, the index of the part `name`.
    pub(crate) fn find_copy(&self, name: &str, ending: &str, at: Origin) -> Read<usize> {
        self.get(&format!("{name}{ending}")).map_or_else(|| self.find(name, at), Ok)
    }

    pub(crate) fn get(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).map(|(number, _)| *number)
    }
}
