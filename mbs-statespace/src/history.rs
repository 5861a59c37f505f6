//! State that one step leaves for the next beside that of the model: the choice of independent coordinates, and how good it was.

use crate::elimination::Order;
use crate::workspace::Workspace;
use mbs_core::Real;

/// State of a [`Workspace`] that the next step continues from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// The pivots that are kept.
    pub order: Order<T>,
    /// Smallest pivot at the start, or the largest of the smallest ones at later choices [-].
    pub usual: T,
    /// Largest entry of R at the last choice; zero: not known yet [-].
    pub first_basis: T,
    /// The next step chooses anew.
    pub is_stale: bool,
    /// Choices since the start.
    pub choices: u32,
}

impl<T: Real> Workspace<T> {
    /// State that the next step continues from.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let Self { usual, first_basis, is_stale, choices, .. } = *self;
        History { order: self.elimination.order(), usual, first_basis, is_stale, choices }
    }

    /// Restores the history of the same model. Returns whether it is one; else nothing is changed but, at most, that the next
    /// step chooses anew.
    pub fn set_history(&mut self, history: &History<T>) -> bool {
        let is_ours = history.is_stale || history.order.pivots.len() == self.rank;
        if !is_ours || !self.elimination.set_order(&history.order) {
            self.is_stale |= is_ours;
            return false;
        }
        (self.usual, self.first_basis) = (history.usual, history.first_basis);
        (self.is_stale, self.choices) = (history.is_stale, history.choices);
        true
    }
}
