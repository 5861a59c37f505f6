//! Report of how a paced run kept up with the clock: an object of its JSON, and a line of CSV for each overrun.

use mbs_scene::format::shortest;
use std::io::{self, Write};

/// A run that was paced. Times in seconds.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct RealtimeSummary {
    /// `finish`, `hold` or `degrade`.
    pub overrun: &'static str,
    /// Time between two boundaries.
    pub period: f64,
    /// Steps of a period at level 0; absent where their lengths are controlled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_per_period: Option<u32>,
    /// Periods that were simulated.
    pub periods: u64,
    /// Was every period ready by its end?
    pub deadline_held: bool,
    /// Periods that were not.
    pub overruns: u64,
    /// Longest delay of a period.
    pub latest: f64,
    /// Delay with which periods began that no period before had delayed.
    pub jitter: Times,
    /// Time of the computation of a period.
    pub duration: Times,
    /// Time left until the deadline; negative where it was missed.
    pub margin: MarginSummary,
    /// Simulated time over the time of the computation alone.
    pub real_time_factor: f64,
    /// From the first begin to the last end.
    pub elapsed: f64,
    /// Delay of the last result behind the clock.
    pub behind: f64,
    /// Periods by which `hold` put the schedule off.
    pub skipped: u64,
    /// Periods below level 0: their results are not those of the full scene.
    pub degraded_periods: u64,
    /// The ladder of `degrade`, level 0 first; empty with other policies.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub levels: Vec<Degraded>,
    /// Overruns and changes of level, the first thousand.
    pub log: Vec<Overrun>,
    /// Number of overruns and changes of level beyond those in the log.
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
    /// Least of the margins.
    pub least: f64,
    /// First percentile of the margins: 99 of 100 are not smaller.
    pub p1: f64,
    /// Median of the margins.
    pub p50: f64,
}

/// A level of the ladder.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Degraded {
    /// Number of the level: 0 is the full scene.
    pub level: usize,
    /// Times the length of a step at level 0.
    pub step_times: f64,
    /// Names of the effects that it leaves out.
    pub without: Vec<String>,
    /// Periods that ran at it.
    pub periods: u64,
    /// The measured share of the time of a period that it saves; `null` where nothing was measured, as in what follows.
    pub saves: Option<f64>,
    /// The time from the start over which it was measured [s].
    pub measured_over: Option<f64>,
    /// The measured largest change of an output, as a share of the output's range.
    pub changes: Option<f64>,
    /// The output that changes so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
}

/// A period that was late, or after which the level changed.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Overrun {
    /// Number of the period, from 0.
    pub index: u64,
    /// Simulated time at its end [s].
    pub time: f64,
    /// When its computation ended, since the run began [s].
    pub at: f64,
    /// Time that the computation took [s].
    pub duration: f64,
    /// Time by which the deadline was missed [s]; 0 where it was not.
    pub late: f64,
    /// The level at which it ran.
    pub level: usize,
    /// `finished`, `held`, `down` or `up`.
    pub action: &'static str,
    /// The level of the next period.
    pub next_level: usize,
    /// Periods in which the last outputs stood on.
    pub held_periods: u64,
}

/// Writes one line for each overrun and each change of level.
///
/// # Errors
/// Those of the sink.
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
