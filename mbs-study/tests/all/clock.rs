//! A clock for tests.

use mbs_study::auto::Clock;

/// A clock that counts work: the same on every machine, so that a choice and an estimate are too.
#[derive(Default)]
pub(crate) struct CountedClock(f64);

impl Clock for CountedClock {
    fn seconds(&mut self) -> f64 {
        self.0
    }

    fn worked(&mut self, nominal: f64) {
        self.0 += nominal;
    }
}
