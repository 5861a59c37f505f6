//! The alarm of a run: its energy invariant has drifted too far.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;

/// Steps in a row, or less at the end of a run, with a larger error before the run stops [-]. The first steps from rest exchange little
/// energy: their error may be large beside it and small beside what follows. Chosen, not tuned.
const STEPS_IN_A_ROW: u32 = 10;

/// Steps in a row after which the invariant was off.
#[derive(Debug, Clone, Copy)]
pub struct Alarm {
    /// Share of the energy turned over that it may be off by.
    share: f64,
    off: u32,
}

impl Alarm {
    /// Makes an alarm with a limit, as a fraction of the exchanged energy.
    pub fn new(share: f64) -> Self {
        Self { share, off: 0 }
    }

    /// Writes what it remembers, or reads it back.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.small(&mut self.off)
    }

    /// Has the invariant drifted too far after this step?
    pub fn rings<T: Real, const D: usize>(
        &mut self,
        simulation: &Simulation<T, D>,
        is_last: bool,
    ) -> Option<StopError> {
        self.rings_for(simulation, is_last, None)
    }

    /// Rings as [`rings`](Self::rings) does, with another reason for which steps in a row may be off.
    pub fn rings_for<T: Real, const D: usize>(
        &mut self,
        simulation: &Simulation<T, D>,
        is_last: bool,
        reason: Option<StopError>,
    ) -> Option<StopError> {
        let invariant = simulation.invariant();
        let is_off = invariant.is_off(self.share);
        let (error, turned_over) = (invariant.error().abs(), invariant.turned_over());
        self.off = if is_off || reason.is_some() { self.off + 1 } else { 0 };
        if self.off >= STEPS_IN_A_ROW && reason.is_some() {
            return reason;
        }
        let is_stop = self.off >= STEPS_IN_A_ROW || (is_off && is_last) || !error.is_finite();
        is_stop.then(|| StopError::Energy {
            error,
            turned_over,
            share: self.share,
            owner: simulation.most_loaded(),
        })
    }
}
