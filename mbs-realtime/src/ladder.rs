//! Level at which the next task runs: it goes down after an overrun and up after a quiet time, with hysteresis.
//!
//! ```text
//! down: the task was late and took longer than a period, or more than `patience` tasks in a row were late
//! up:   `tasks` × f tasks in a row were in time and took at most `share` of a period
//! f:    doubled, up to 64, by a fall that comes before a rise has lasted as long as the quiet time; 1 again after one that has
//! ```
//!
//! A task that is late only because it began late does not show that its level is too high. Tasks shorter than a period reduce the delay.

use crate::log::Action;
use std::time::Duration;

/// Largest value of the factor f on the quiet time [-]. It is reached after six doublings. Chosen, not tuned.
const MOST_TIMES: u32 = 64;

/// Condition on which a degraded loop goes up one level. The quiet time is the time in which `tasks` light tasks follow one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recovery {
    /// Number of successive tasks that must be in time and light. `≥ 1`.
    pub tasks: u32,
    /// Duration up to which a task is light, in percent of a period. `1 ..= 100`.
    pub percent: u32,
    /// Number of successive late tasks, each shorter than a period, that are allowed at a level. After one more the level goes down,
    /// because the delay does not disappear.
    pub patience: u32,
}

impl Default for Recovery {
    /// Returns 500 tasks of at most 70 % of a period, with a patience of 10 tasks.
    fn default() -> Self {
        Self { tasks: 500, percent: 70, patience: 10 }
    }
}

/// Present level of a loop, and the counts that change it.
#[derive(Debug, Clone)]
pub(crate) struct DegradationLadder {
    quiet: Recovery,
    period: Duration,
    last: usize,
    level: usize,
    late_in_row: u32,
    quiet_in_row: u64,
    /// Factor f of the quiet time [-].
    times: u32,
    /// Tasks since the last rise; `None` once the rise has lasted as long as the quiet time.
    since_rise: Option<u64>,
}

impl DegradationLadder {
    /// Creates a ladder of `levels` `≥ 1` levels. At level 0 the loop does all its work, at level `levels − 1` the least.
    pub(crate) fn new(quiet: Recovery, period: Duration, levels: usize) -> Self {
        Self {
            quiet,
            period,
            last: levels.saturating_sub(1),
            level: 0,
            late_in_row: 0,
            quiet_in_row: 0,
            times: 1,
            since_rise: None,
        }
    }

    pub(crate) fn level(&self) -> usize {
        self.level
    }

    /// Counts a task on the ladder. Returns the action after the task, if there is one.
    pub(crate) fn after(&mut self, is_late: bool, duration: Duration) -> Option<Action> {
        self.watch_rise();
        if is_late { Some(self.late(duration)) } else { self.in_time(duration) }
    }

    fn late(&mut self, duration: Duration) -> Action {
        self.quiet_in_row = 0;
        self.late_in_row += 1;
        let is_own = duration > self.period || self.late_in_row > self.quiet.patience;
        if !is_own || self.level == self.last {
            return Action::Finished;
        }
        if self.since_rise.take().is_some() {
            self.times = (self.times * 2).min(MOST_TIMES);
        }
        self.late_in_row = 0;
        self.level += 1;
        Action::Down { to: self.level }
    }

    fn in_time(&mut self, duration: Duration) -> Option<Action> {
        self.late_in_row = 0;
        let is_light = duration * 100 <= self.period * self.quiet.percent;
        self.quiet_in_row = if is_light { self.quiet_in_row + 1 } else { 0 };
        if self.level == 0 || self.quiet_in_row < self.needed() {
            return None;
        }
        self.quiet_in_row = 0;
        self.since_rise = Some(0);
        self.level -= 1;
        Some(Action::Up { to: self.level })
    }

    /// Resets the factor f to one when a rise has lasted as long as the quiet time.
    fn watch_rise(&mut self) {
        let needed = self.needed();
        if let Some(tasks) = &mut self.since_rise {
            *tasks += 1;
            if *tasks >= needed {
                (self.since_rise, self.times) = (None, 1);
            }
        }
    }

    fn needed(&self) -> u64 {
        u64::from(self.quiet.tasks) * u64::from(self.times)
    }
}
