//! Owners (joint, body or coupling) of the freedoms, links and rows of a tree, for messages.

use crate::build::tree::TreeModel;
use crate::link::Link;
use crate::loops::index;
use crate::rows::Row;
use crate::space::Space;
use mbs_core::Real;
use mbs_core::model::Owner;

impl<T: Real, S: Space<T>> TreeModel<T, S> {
    /// Returns the owner of a freedom, for messages.
    #[must_use]
    pub fn owner_of_unknown(&self, unknown: usize) -> Owner {
        let owns = |link: &Link<T, S>| {
            let first = link.v as usize;
            (first..first + link.kind.n_freedoms::<T, S>()).contains(&unknown)
        };
        let link = self.links.iter().skip(1).position(owns).map_or(0, |i| i + 1);
        self.owner_of_link[link]
    }

    /// Returns the owner of a link, for messages.
    #[must_use]
    pub fn owner_of_link(&self, link: usize) -> Owner {
        self.owner_of_link[link]
    }

    /// Returns the owner of a row, for messages.
    #[must_use]
    pub fn owner_of_row(&self, row: usize) -> Owner {
        let lap = self.loops.iter().find(|l| (l.first..l.first + l.n).contains(&index(row)));
        let number = lap.map_or(0, |lap| lap.joint as usize);
        match self.rows.get(row) {
            Some(Row::Coupled(_)) => Owner::Coupling(number),
            Some(Row::Height { .. } | Row::NoSlip { .. } | Row::Blade { .. }) => {
                Owner::Rolling(number)
            }
            _ => Owner::Joint(number),
        }
    }
}
