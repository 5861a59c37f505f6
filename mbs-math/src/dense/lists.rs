//! Cliques stored by a solver, one after the other.

use crate::blocks::Cliques;
use alloc::vec;
use alloc::vec::Vec;

/// The cliques of all elements, in one list.
#[derive(Debug, Clone)]
pub(crate) struct Lists {
    unknowns: Vec<u32>,
    /// Start of each clique, and the end of the last one.
    starts: Vec<usize>,
}

impl Lists {
    pub(crate) fn of(cliques: &impl Cliques) -> Self {
        let (mut unknowns, mut starts) = (Vec::new(), vec![0]);
        for e in 0..cliques.n_elements() {
            unknowns.extend_from_slice(cliques.clique(e));
            starts.push(unknowns.len());
        }
        Self { unknowns, starts }
    }

    /// The cliques, in the order of the elements.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|ends| &self.unknowns[ends[0]..ends[1]])
    }

    /// Number of unknowns of the largest clique.
    pub(crate) fn largest(&self) -> usize {
        self.iter().map(<[u32]>::len).max().unwrap_or(0)
    }
}
