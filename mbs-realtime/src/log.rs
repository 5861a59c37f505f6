//! Events out of the ordinary: overruns and changes of level, in bounded memory.

use std::time::Duration;

/// Action after a task that was late, or after which the level changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Action {
    /// Late task that was finished; the next began at once.
    Finished,
    /// Late task whose result was held back for this many periods.
    Held {
        /// Periods in which the last result stood on.
        periods: u64,
    },
    /// Late task, after which the next one runs at this level.
    Down {
        /// Level of the next task.
        to: usize,
    },
    /// In time, and quiet for long enough; the next one runs at this level.
    Up {
        /// Level of the next task.
        to: usize,
    },
}

/// A task that was late, or after which the level changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// Number of the task, from 0.
    pub task: u64,
    /// When it ended, since the loop began.
    pub at: Duration,
    /// Duration of the task.
    pub duration: Duration,
    /// Time by which the task missed its deadline; zero where it did not.
    pub late: Duration,
    /// The level at which it ran.
    pub level: usize,
    /// Action that was taken.
    pub action: Action,
}

/// The first entries, and how many more there were.
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

    /// Takes one more entry, without allocation.
    pub(crate) fn take(&mut self, entry: Entry) {
        if self.entries.len() < self.capacity {
            self.entries.push(entry);
        } else {
            self.left_out += 1;
        }
    }
}
