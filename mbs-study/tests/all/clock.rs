//! A clock for tests.

use mbs_study::auto::Clock;

/// Clock that counts work. It gives the same times on every machine, so that choices and estimates are the same too.
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
