//! Memory that one step leaves for the next step in addition to the state. It can be read and restored.

use crate::host::state::Workspace;
use crate::link::options::Options;
use crate::space::Space;
use alloc::vec::Vec;
use mbs_core::Real;
use mbs_core::ode::{
    Adaptive, AdaptiveHistory, Extrapolation, Method, Radau, RadauHistory, Tableau,
};

/// Memory of a [`Workspace`] from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct History<T> {
    /// Largest number of independent rows so far.
    pub rank: usize,
    /// Pivots of the cut joints' rows in the last factorisation, one for each row.
    pub pivots: Vec<T>,
    /// Error control of the pair 5(4), if it was used.
    pub pair: Option<AdaptiveHistory<T>>,
    /// Error control of the method 8(5,3), if it was used.
    pub eighth: Option<AdaptiveHistory<T>>,
    /// Error control of extrapolation, if it was used.
    pub extrapolation: Option<AdaptiveHistory<T>>,
    /// Error control of Radau collocation with its Jacobian, if it was used.
    pub radau: Option<(AdaptiveHistory<T>, RadauHistory<T>)>,
}

impl<T: Real, S: Space<T>> Workspace<T, S> {
    /// Returns the memory from which the next step continues.
    #[must_use]
    pub fn history(&self) -> History<T> {
        let (rank, pivots) = self.last();
        History {
            rank,
            pivots: pivots.to_vec(),
            pair: self.explicit.pair.as_ref().map(Adaptive::history),
            eighth: self.explicit.eighth.as_ref().map(Adaptive::history),
            extrapolation: self.explicit.extrapolation.as_ref().map(Adaptive::history),
            radau: self.explicit.radau.as_ref().map(|r| (r.history(), r.method().history())),
        }
    }

    /// Restores a history that was read from a workspace of the same model with the same `options`. Returns false and changes nothing if
    /// the history does not fit the model, for example because it has another number of rows.
    pub fn set_history(&mut self, history: &History<T>, options: &Options<T>) -> bool {
        let n = self.explicit.y.len();
        let (s, explicit) = self.parts();
        if history.pivots.len() != s.loops.pivots.len() || history.rank > history.pivots.len() {
            return false;
        }
        let pair = driver(history.pair, Tableau::dormand_prince);
        let eighth = driver(history.eighth, Tableau::dormand_prince_8);
        let extrapolated = || Extrapolation::for_tolerance(options.error);
        let extrapolation = driver(history.extrapolation, extrapolated);
        let own = || Radau::new(n, s.z.len());
        let Some(mut radau) = driver(history.radau.as_ref().map(|(steps, _)| *steps), own) else {
            return false;
        };
        let (Some(pair), Some(eighth), Some(extrapolation)) = (pair, eighth, extrapolation) else {
            return false;
        };
        if let (Some(driver), Some((_, slopes))) = (&mut radau, &history.radau)
            && !driver.method_mut().set_history(slopes)
        {
            return false;
        }
        explicit.radau = radau;
        *s.rank = history.rank;
        s.loops.pivots.copy_from_slice(&history.pivots);
        (explicit.pair, explicit.eighth) = (pair, eighth);
        explicit.extrapolation = extrapolation;
        true
    }
}

/// Makes the driver of a method with error control from its history. Returns `Some(None)` if there is no history, and `None` if the history
/// does not fit the method.
fn driver<T: Real, M: Method<T>>(
    history: Option<AdaptiveHistory<T>>,
    method: impl FnOnce() -> M,
) -> Option<Option<Adaptive<T, M>>> {
    let Some(history) = history else { return Some(None) };
    let mut driver = Adaptive::new(method(), T::ONE);
    driver.set_history(history).then_some(Some(driver))
}
