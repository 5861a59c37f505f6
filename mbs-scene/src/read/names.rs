//! Names of bodies or joints, found without a walk along the file.

use std::collections::HashMap;

/// Names in file order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Names {
    list: Vec<String>,
    /// Position at which each name stands first.
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

    /// All names, in file order.
    pub(crate) fn list(&self) -> &[String] {
        &self.list
    }

    /// Position at which a name stands first.
    pub(crate) fn place(&self, name: &str) -> Option<usize> {
        self.first.get(name).copied()
    }
}
