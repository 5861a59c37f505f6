//! Energy alarm: it stops a run whose energy invariant has drifted too far.

use crate::checkpoint::tape::{Tape, Walked};
use crate::simulation::Simulation;
use crate::stop::StopError;
use mbs_core::Real;

/// Number of successive steps with too large an error before the run stops [-]. At the end of a run one such step suffices. The first steps
/// from rest exchange little energy. Their error can be large relative to that energy, yet small relative to the energy of later steps.
/// Chosen, not tuned.
const STEPS_IN_A_ROW: u32 = 10;

/// Counter of successive steps with too large an error of the energy invariant.
#[derive(Debug, Clone, Copy)]
pub struct Alarm {
    /// Allowed error, as a fraction of the exchanged energy [-].
    share: f64,
    off: u32,
}

impl Alarm {
    /// Makes an alarm with an allowed error, as a fraction of the exchanged energy [-].
    pub fn new(share: f64) -> Self {
        Self { share, off: 0 }
    }

    /// Writes the counter to a checkpoint, or reads it from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.small(&mut self.off)
    }

    /// Returns the error with which the run must stop after this step; `None` if the error of the invariant is allowed.
    pub fn rings<T: Real, const D: usize>(
        &mut self,
        simulation: &Simulation<T, D>,
        is_last: bool,
    ) -> Option<StopError> {
        self.rings_for(simulation, is_last, None)
    }

    /// Checks as [`rings`](Self::rings) does. A step for which `reason` is given counts as well, and the run then stops with `reason`.
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
