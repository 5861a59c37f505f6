//! Measures of a paced loop.

use crate::log::Entry;
use crate::sample::{Sample, nearest_rank};
use std::time::Duration;

/// Half, 99 of 100, and all of some times are not longer than these.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Spread {
    /// Median of the times.
    pub p50: Duration,
    /// 99th percentile of the times.
    pub p99: Duration,
    /// Longest of the times.
    pub max: Duration,
}

/// Time left until the deadline [s]; negative where it was missed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Margin {
    /// Least of the margins.
    pub least: f64,
    /// 99 of 100 were larger, or equal.
    pub p1: f64,
    /// Median of the margins.
    pub p50: f64,
}

/// Measures of a loop so far.
///
/// Percentiles are exact up to 65,536 tasks; of longer loops they are those of every second task, fourth, and so on. Extremes and
/// counts are of all.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Tasks that were done.
    pub tasks: u64,
    /// Delays with which tasks began; tasks that the one before delayed are not counted.
    pub jitter: Spread,
    /// Durations of tasks, from their begin to their end.
    pub duration: Spread,
    /// Time left until the deadlines.
    pub margin: Margin,
    /// Tasks that ended after their deadline.
    pub overruns: u64,
    /// The longest of their delays.
    pub latest: Duration,
    /// Overruns and changes of level, the first ones.
    pub log: Vec<Entry>,
    /// Number of overruns and changes of level beyond the listed ones.
    pub log_left_out: u64,
    /// Tasks at each level.
    pub at_level: Vec<u64>,
    /// Periods by which the schedule was put off ([`Hold`](crate::Overrun::Hold)).
    pub skipped: u64,
    /// Delay of the last result behind the clock: what was put off, and how late it was.
    pub behind: Duration,
    /// From the begin of the first task to the end of the last.
    pub elapsed: Duration,
    /// The time of the tasks alone.
    pub busy: Duration,
    /// Tasks × period / busy: how many times faster than real time the work is.
    pub real_time_factor: f64,
}

impl Report {
    /// Did every task end by its deadline?
    #[must_use]
    pub fn held(&self) -> bool {
        self.overruns == 0
    }
}

/// Percentiles of times that are not negative.
pub(crate) fn spread(sample: &Sample) -> Spread {
    let Some((sorted, [_, max])) = sample.sorted() else { return Spread::default() };
    let time = |nanos: i64| Duration::from_nanos(u64::try_from(nanos).unwrap_or(0));
    let of = |percent| time(nearest_rank(&sorted, percent).copied().unwrap_or(0));
    Spread { p50: of(50), p99: of(99), max: time(max) }
}

/// Least value and percentiles of margins.
pub(crate) fn margin(sample: &Sample) -> Margin {
    let Some((sorted, [least, _])) = sample.sorted() else { return Margin::default() };
    #[allow(clippy::cast_precision_loss, reason = "nanoseconds of some months")]
    let seconds = |nanos: i64| nanos as f64 * 1e-9;
    let of = |percent| seconds(nearest_rank(&sorted, percent).copied().unwrap_or(0));
    Margin { least: seconds(least), p1: of(1), p50: of(50) }
}
