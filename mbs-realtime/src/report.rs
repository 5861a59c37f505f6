//! Measures of a paced loop: times, margins and counts.

use crate::log::Entry;
use crate::sample::{Sample, nearest_rank};
use std::time::Duration;

/// Percentiles of a set of times.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Spread {
    /// Median of the times.
    pub p50: Duration,
    /// 99th percentile of the times.
    pub p99: Duration,
    /// Longest of the times.
    pub max: Duration,
}

/// Time left until the deadline [s]; negative after a missed deadline.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Margin {
    /// Smallest of the margins.
    pub least: f64,
    /// First percentile: 99 of 100 margins are at least as large.
    pub p1: f64,
    /// Median of the margins.
    pub p50: f64,
}

/// Measures of a loop so far.
///
/// Percentiles are exact for up to 65,536 tasks. In longer loops they are computed from every second task, then from every fourth, and so
/// on. Extremes and counts include all tasks.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Number of tasks done.
    pub tasks: u64,
    /// Delays of the begins of tasks. A delay that the previous task caused is not included.
    pub jitter: Spread,
    /// Durations of tasks, from their begin to their end.
    pub duration: Spread,
    /// Margins: times left until the deadlines.
    pub margin: Margin,
    /// Number of tasks that ended after their deadline.
    pub overruns: u64,
    /// Longest delay after a deadline.
    pub latest: Duration,
    /// The first overruns and changes of level.
    pub log: Vec<Entry>,
    /// Number of overruns and changes of level that the log does not contain.
    pub log_left_out: u64,
    /// Number of tasks at each level.
    pub at_level: Vec<u64>,
    /// Number of periods by which the schedule was shifted ([`Hold`](crate::Overrun::Hold)).
    pub skipped: u64,
    /// Delay of the last result relative to the clock: the shift of the schedule plus the delay of the last task.
    pub behind: Duration,
    /// Time from the begin of the first task to the end of the last one.
    pub elapsed: Duration,
    /// Time of the tasks alone, without waiting.
    pub busy: Duration,
    /// Real-time factor [-]: tasks × period / busy. The work takes this many times less than real time.
    pub real_time_factor: f64,
}

impl Report {
    /// True if every task ended by its deadline.
    #[must_use]
    pub fn held(&self) -> bool {
        self.overruns == 0
    }
}

/// Returns percentiles of times that are not negative.
pub(crate) fn spread(sample: &Sample) -> Spread {
    let Some((sorted, [_, max])) = sample.sorted() else { return Spread::default() };
    let time = |nanos: i64| Duration::from_nanos(u64::try_from(nanos).unwrap_or(0));
    let of = |percent| time(nearest_rank(&sorted, percent).copied().unwrap_or(0));
    Spread { p50: of(50), p99: of(99), max: time(max) }
}

/// Returns the smallest value and percentiles of margins.
pub(crate) fn margin(sample: &Sample) -> Margin {
    let Some((sorted, [least, _])) = sample.sorted() else { return Margin::default() };
    #[allow(clippy::cast_precision_loss, reason = "nanoseconds of some months")]
    let seconds = |nanos: i64| nanos as f64 * 1e-9;
    let of = |percent| seconds(nearest_rank(&sorted, percent).copied().unwrap_or(0));
    Margin { least: seconds(least), p1: of(1), p50: of(50) }
}
