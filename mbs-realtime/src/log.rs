//! Log of overruns and changes of level, in bounded memory.

use std::time::Duration;

/// Action after a task that was late or that changed the level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Late task whose result was published at once; the next task also began at once.
    Finished,
    /// Late task whose result was held until the end of a period.
    Held {
        /// Number of periods for which the previous result remained valid.
        periods: u64,
    },
    /// Late task, after which the level goes down to this one.
    Down {
        /// Level of the next task.
        to: usize,
    },
    /// Task at the end of a quiet time, after which the level goes up to this one.
    Up {
        /// Level of the next task.
        to: usize,
    },
}

/// A task that was late, or after which the level changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// Index of the task, from 0.
    pub task: u64,
    /// Time of the task's end, from the begin of the loop.
    pub at: Duration,
    /// Duration of the task.
    pub duration: Duration,
    /// Time by which the task missed its deadline; zero if it was in time.
    pub late: Duration,
    /// Level at which the task ran.
    pub level: usize,
    /// Action after the task.
    pub action: Action,
}

/// The first entries, and the number of further ones.
#[derive(Debug, Clone)]
pub(crate) struct Log {
    pub(crate) entries: Vec<Entry>,
    pub(crate) left_out: u64,
    capacity: usize,
}

impl Log {
    pub(crate) fn new(capacity: usize) -> Self {
        Self { entries: Vec::with_capacity(capacity), left_out: 0, capacity }
    }

    /// Adds an entry without allocation, or counts it if the log is full.
    pub(crate) fn take(&mut self, entry: Entry) {
        if self.entries.len() < self.capacity {
            self.entries.push(entry);
        } else {
            self.left_out += 1;
        }
    }
}
