//! CPU time of the steps of a run.

use core::time::Duration;
use cpu_time::{ProcessTime, ThreadTime};

/// CPU time of the steps, summed over all parts of a resumed run.
#[derive(Debug)]
pub(super) struct Clock {
    begun: Begun,
    /// CPU time of the parts before the last resumption.
    pub(super) before: Duration,
    /// CPU time of writing files, which is not included.
    apart: Duration,
}

impl Clock {
    /// Starts the clock at zero, for steps that run on this number of threads.
    pub(super) fn new(threads: usize) -> Self {
        Self { begun: Begun::now(threads == 1), before: Duration::ZERO, apart: Duration::ZERO }
    }

    /// Restarts the clock for a further part of a run. The time of earlier parts is kept.
    pub(super) fn begin(&mut self) {
        let is_alone = matches!(self.begun, Begun::Thread(_));
        (self.begun, self.apart) = (Begun::now(is_alone), Duration::ZERO);
    }

    /// The CPU time of the steps so far.
    pub(super) fn get(&self) -> Duration {
        (self.before + self.begun.elapsed()).saturating_sub(self.apart)
    }

    /// Excludes the time from `since`, an earlier value of `get`, until now.
    pub(super) fn take_off(&mut self, since: Duration) {
        self.apart += self.get().saturating_sub(since);
    }
}

/// Start of the measurement. Steps on one thread are measured by thread time, steps on several threads by process time. With thread time,
/// parallel runs in one process do not include each other's time.
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
