//! State on which the next step depends besides the model's state: the choice of independent coordinates, and its quality.

use crate::elimination::Order;
use crate::workspace::Workspace;
use mbs_core::Real;

/// State of a [`Workspace`] on which the next step depends.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Order of the reused pivots.
    pub order: Order<T>,
    /// Smallest pivot at the start, or at a later choice if it was larger there [-].
    pub usual: T,
    /// Largest entry of R at the last choice [-]; zero while unknown.
    pub first_basis: T,
    /// True if the next step chooses independent coordinates again.
    pub is_stale: bool,
    /// Number of choices of independent coordinates since the start.
    pub choices: u32,
}

impl<T: Real> Workspace<T> {
    /// State on which the next step depends.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let Self { usual, first_basis, is_stale, choices, .. } = *self;
        History { order: self.elimination.order(), usual, first_basis, is_stale, choices }
    }

    /// Restores a history of the same model. Returns false if it does not fit. In that case either nothing changes, or the next step
    /// chooses independent coordinates again.
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
