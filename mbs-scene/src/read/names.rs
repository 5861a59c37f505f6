//! Names of bodies or joints, with a hash map for finding them.

use std::collections::HashMap;

/// Names of the entries of a list, in the order of the file.
#[derive(Debug, Clone, Default)]
pub(crate) struct Names {
    list: Vec<String>,
    /// Index of the first entry of each name.
    first: HashMap<String, usize>,
}

impl Names {
    pub(crate) fn new(list: Vec<String>) -> Self {
        let mut first = HashMap::with_capacity(list.len());
        for (i, name) in list.iter().enumerate() {
            first.entry(name.clone()).or_insert(i);
        }
        Self { list, first }
    }

    /// All names, in the order of the file.
    pub(crate) fn list(&self) -> &[String] {
        &self.list
    }

    /// Index of the first entry of this name.
    pub(crate) fn place(&self, name: &str) -> Option<usize> {
        self.first.get(name).copied()
    }
}
