//! CPU time of the steps of a run.

use core::time::Duration;
use cpu_time::{ProcessTime, ThreadTime};

/// CPU time of the steps, over all starts of a run.
#[derive(Debug)]
pub(super) struct Clock {
    begun: Begun,
    /// CPU time of earlier starts.
    pub(super) before: Duration,
    /// CPU time of writing.
    apart: Duration,
}

impl Clock {
    /// Begins now, after nothing; so many threads share the steps.
    pub(super) fn new(threads: usize) -> Self {
        Self { begun: Begun::now(threads == 1), before: Duration::ZERO, apart: Duration::ZERO }
    }

    /// Begins now, after what was before.
    pub(super) fn begin(&mut self) {
        let is_alone = matches!(self.begun, Begun::Thread(_));
        (self.begun, self.apart) = (Begun::now(is_alone), Duration::ZERO);
    }

    /// The time so far.
    pub(super) fn get(&self) -> Duration {
        (self.before + self.begun.elapsed()).saturating_sub(self.apart)
    }

    /// Takes off what was done since `get` returned this.
    pub(super) fn take_off(&mut self, since: Duration) {
        self.apart += self.get().saturating_sub(since);
    }
}

/// When it was begun, by a clock that runs for those who share the steps and for no others: runs side by side in a process count each
/// time once.
#[derive(Debug, Clone, Copy)]
enum Begun {
    Thread(ThreadTime),
    Process(ProcessTime),
}

impl Begun {
    fn now(is_alone: bool) -> Self {
        if is_alone { Self::Thread(ThreadTime::now()) } else { Self::Process(ProcessTime::now()) }
    }

    fn elapsed(&self) -> Duration {
        match self {
            Self::Thread(begun) => begun.elapsed(),
            Self::Process(begun) => begun.elapsed(),
        }
    }
}
