//! The clock that a loop is paced by: a trait, so that tests bring one of their own.

use std::time::{Duration, Instant};

/// A clock that never goes back, and ways to wait for it.
pub trait Clock {
    /// Time since some instant that stays the same.
    fn now(&self) -> Duration;

    /// Gives the processor away for at least `time`; it may take longer to come back.
    fn sleep(&mut self, time: Duration);

    /// One turn of waiting awake.
    fn pause(&mut self);
}

impl<C: Clock + ?Sized> Clock for &mut C {
    fn now(&self) -> Duration {
        (**self).now()
    }

    fn sleep(&mut self, time: Duration) {
        (**self).sleep(time);
    }

    fn pause(&mut self) {
        (**self).pause();
    }
}

/// The monotonic clock of the system, from when it was made.
#[derive(Debug, Clone, Copy)]
pub struct SystemClock(Instant);

impl SystemClock {
    /// Starts the clock at zero.
    #[must_use]
    pub fn new() -> Self {
        Self(Instant::now())
    }
}

impl Default for SystemClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for SystemClock {
    fn now(&self) -> Duration {
        self.0.elapsed()
    }

    fn sleep(&mut self, time: Duration) {
        std::thread::sleep(time);
    }

    fn pause(&mut self) {
        std::hint::spin_loop();
    }
}

/// Waits until `target`, asleep until `awake` before it, then awake. Returns at once when it is past.
pub fn wait_until(clock: &mut impl Clock, target: Duration, awake: Duration) {
    let rest = target.saturating_sub(clock.now());
    if rest > awake {
        clock.sleep(rest.saturating_sub(awake));
    }
    while clock.now() < target {
        clock.pause();
    }
}
