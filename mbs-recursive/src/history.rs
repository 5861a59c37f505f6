//! What one step leaves for the next beside the state, to look at and to go on from.

use crate::options::Options;
use crate::space::Space;
use crate::state::Workspace;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::ode::{Adaptive, AdaptiveHistory, Extrapolation, Tableau};

/// What a [`Workspace`] remembers from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Most rows that were seen to have an effect.
    pub rank: usize,
    /// Pivots of the cut joints' rows as factored last, one for each row.
    pub pivots: Vec<T>,
    /// Error control of the pair 5(4), if it was asked for.
    pub pair: Option<AdaptiveHistory<T>>,
    /// The same of extrapolation.
    pub extrapolation: Option<AdaptiveHistory<T>>,
}

impl<T: Real, S: Space<T>> Workspace<T, S> {
    /// What the next step goes on from.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let (rank, pivots) = self.last();
        History {
            rank,
            pivots: pivots.to_vec(),
            pair: self.explicit.pair.as_ref().map(Adaptive::history),
            extrapolation: self.explicit.extrapolation.as_ref().map(Adaptive::history),
        }
    }

    /// Goes on from the history of the same model, stepped with the same `options`. Says whether it is one; else nothing is
    /// changed.
    pub fn set_history(&mut self, history: &History<T>, options: &Options<T>) -> bool {
        let (s, explicit) = self.parts();
        if history.pivots.len() != s.loops.pivots.len() || history.rank > history.pivots.len() {
            return false;
        }
        let mut is_ours = true;
        let mut pair = None;
        if let Some(history) = history.pair {
            let mut driver = Adaptive::new(Tableau::dormand_prince(), T::ONE);
            is_ours &= driver.set_history(history);
            pair = Some(driver);
        }
        let mut extrapolation = None;
        if let Some(history) = history.extrapolation {
            let mut driver = Adaptive::new(Extrapolation::for_tolerance(options.error), T::ONE);
            is_ours &= driver.set_history(history);
            extrapolation = Some(driver);
        }
        if is_ours {
            *s.rank = history.rank;
            s.loops.pivots.copy_from_slice(&history.pivots);
            (explicit.pair, explicit.extrapolation) = (pair, extrapolation);
        }
        is_ours
    }
}
