//! Timing report of a paced run: an object of the run's JSON, and a CSV file with a line for each overrun.

use mbs_scene::format::shortest;
use std::io::{self, Write};

/// Timing of a paced run; all times in seconds.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct RealtimeSummary {
    /// Policy for overruns: `finish`, `hold` or `degrade`.
    pub overrun: &'static str,
    /// Length of a period [s].
    pub period: f64,
    /// Number of steps of a period at level 0; absent with step control.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_period: Option<u32>,
    /// Number of simulated periods.
    pub periods: u64,
    /// True if every period was computed before its deadline.
    pub deadline_held: bool,
    /// Number of periods that missed the deadline.
    pub overruns: u64,
    /// Longest time by which a period missed its deadline [s].
    pub latest: f64,
    /// Delay of the beginning of periods. Periods that an earlier overrun delayed are not included.
    pub jitter: Times,
    /// Computation time of a period.
    pub duration: Times,
    /// Time between the end of the computation and the deadline; negative if the deadline was missed.
    pub margin: MarginSummary,
    /// Simulated time divided by the computation time [-].
    pub real_time_factor: f64,
    /// Clock time from the beginning of the first period to the end of the last one [s].
    pub elapsed: f64,
    /// Time by which the last result was behind the clock [s].
    pub behind: f64,
    /// Number of periods by which `hold` delayed the schedule.
    pub skipped: u64,
    /// Number of periods at a degraded level. Their results differ from those of the full scene.
    pub degraded_periods: u64,
    /// Levels of the degradation ladder, beginning with level 0; empty for other policies.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<Degraded>,
    /// List of overruns and changes of level; it has at most a thousand entries.
    pub log: Vec<Overrun>,
    /// Number of overruns and changes of level that are not in the log.
    pub log_left_out: u64,
}

/// Percentiles of times [s].
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Times {
    /// Median of the times.
    pub p50: f64,
    /// 99th percentile of the times.
    pub p99: f64,
    /// Longest of the times.
    pub max: f64,
}

/// Percentiles of margins [s].
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct MarginSummary {
    /// Smallest of the margins.
    pub least: f64,
    /// First percentile of the margins: 99 of 100 margins are at least as large.
    pub p1: f64,
    /// Median of the margins.
    pub p50: f64,
}

/// Level of the degradation ladder.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Degraded {
    /// Number of the level: 0 is the full scene.
    pub level: usize,
    /// Length of a step divided by the length at level 0 [-].
    pub step_times: f64,
    /// Names of the effects that the level omits.
    pub without: Vec<String>,
    /// Number of periods that ran at the level.
    pub periods: u64,
    /// Measured fraction of the computation time that the level saves [-]. It is `null` without a measurement, as are the next two values.
    pub saves: Option<f64>,
    /// Simulated time from the start, over which the level was measured [s].
    pub measured_over: Option<f64>,
    /// Largest measured change of an output, relative to the range of the output [-].
    pub changes: Option<f64>,
    /// Output with the largest change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
}

/// Period that missed its deadline, or after which the level changed.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Overrun {
    /// Index of the period, counted from 0.
    pub index: u64,
    /// Simulated time at the end of the period [s].
    pub time: f64,
    /// Clock time at the end of the computation, counted from the beginning of the run [s].
    pub at: f64,
    /// Duration of the computation [s].
    pub duration: f64,
    /// Time by which the deadline was missed [s]; 0 if it was met.
    pub late: f64,
    /// Level at which the period was computed.
    pub level: usize,
    /// Action after the period: `finished`, `held`, `down` or `up`.
    pub action: &'static str,
    /// Level of the next period.
    pub next_level: usize,
    /// Number of periods in which the last outputs were repeated.
    pub held_periods: u64,
}

/// Writes one line for each overrun and each change of level.
///
/// # Errors
/// The errors of the sink.
pub fn write_overruns(sink: impl Write, of: &RealtimeSummary) -> io::Result<()> {
    let mut out = csv::Writer::from_writer(sink);
    let head =
        "index t at duration late level action next_level held_periods".split_ascii_whitespace();
    out.write_record(head).map_err(io::Error::from)?;
    for overrun in &of.log {
        let record = [
            overrun.index.to_string(),
            shortest(overrun.time),
            shortest(overrun.at),
            shortest(overrun.duration),
            shortest(overrun.late),
            overrun.level.to_string(),
            overrun.action.to_owned(),
            overrun.next_level.to_string(),
            overrun.held_periods.to_string(),
        ];
        out.write_record(record).map_err(io::Error::from)?;
    }
    out.flush()
}
