//! Time of a simulation that a caller steps. Times are multiples of the step length, because a sum of many steps would accumulate rounding
//! errors.

use crate::checkpoint::tape::{Tape, Walked};
use crate::driver::multiple;
use mbs_core::Real;

/// A series of equal steps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StepClock<T> {
    /// Time at which the series begins [s].
    origin: T,
    /// Length of each step [s], as requested and in the precision of the run.
    dt: (f64, T),
    count: u64,
    /// Time at the end of the last step [s].
    end: T,
}

impl<T: Real> StepClock<T> {
    /// Returns the time after one more step of `dt` [s] from `now`.
    pub fn advance(&mut self, now: T, dt: (f64, T)) -> T {
        if self.dt.0.to_bits() != dt.0.to_bits() || self.end != now {
            *self = Self { origin: now, dt, count: 0, end: now };
        }
        self.count += 1;
        self.end =
            multiple((self.origin, self.origin.to_f64()), self.count, (self.dt.1, self.dt.0));
        self.end
    }

    /// Writes the clock to a checkpoint, or reads it from one.
    pub fn walk(&mut self, tape: &mut impl Tape) -> Walked {
        tape.real(&mut self.origin)?;
        tape.float(&mut self.dt.0)?;
        tape.real(&mut self.dt.1)?;
        tape.count(&mut self.count)?;
        tape.real(&mut self.end)
    }

    /// Sets the time at which the last step ended [s].
    pub fn land(&mut self, at: T) {
        self.end = at;
    }
}
