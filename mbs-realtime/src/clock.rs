//! Clock of a paced loop: a trait, so that tests can use another clock.

use std::time::{Duration, Instant};

/// A clock that never goes back, with two ways to wait.
pub trait Clock {
    /// Returns the time since a fixed instant.
    fn now(&self) -> Duration;

    /// Releases the processor for at least `time`. The wake-up may come later.
    fn sleep(&mut self, time: Duration);

    /// Makes one pass of an active wait.
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

/// The monotonic clock of the system; zero is the time of its creation.
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

/// Waits until `target`: asleep until the time `awake` before it, then actively. Returns at once if `target` is past.
pub fn wait_until(clock: &mut impl Clock, target: Duration, awake: Duration) {
    let rest = target.saturating_sub(clock.now());
    if rest > awake {
        clock.sleep(rest.saturating_sub(awake));
    }
    while clock.now() < target {
        clock.pause();
    }
}
