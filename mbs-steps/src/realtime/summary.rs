//! Measurements of a pacer, converted to their form in files.

use crate::record::{Degraded, MarginSummary, Overrun as Logged, RealtimeSummary, Times};
use crate::run::{PacedLevel, PacedSchedule};
use mbs_realtime::{Action, Entry, Overrun, Pacer, Spread};

/// Names of the policies for overruns.
pub const OVERRUNS: [(&str, Overrun); 3] =
    [("finish", Overrun::Finish), ("hold", Overrun::Hold), ("degrade", Overrun::Degrade)];

/// Returns the name of a policy in files.
fn name(overrun: Overrun) -> &'static str {
    OVERRUNS.iter().find(|(_, other)| *other == overrun).map_or("", |(name, _)| name)
}

/// Creates the timing report from a pacer and the schedule of the run.
pub fn summary<T>(
    pacer: &Pacer,
    track: &PacedSchedule<T>,
    rungs: &[PacedLevel],
) -> RealtimeSummary {
    let report = pacer.report();
    let times = |of: Spread| {
        let [p50, p99, max] = [of.p50, of.p99, of.max].map(|time| time.as_secs_f64());
        Times { p50, p99, max }
    };
    let level = |(i, rung): (usize, &PacedLevel)| {
        let periods = report.at_level.get(i).copied().unwrap_or(0);
        Degraded { level: i, periods, ..rung.measured.clone() }
    };
    let levels: Vec<Degraded> = rungs.iter().enumerate().map(level).collect();
    RealtimeSummary {
        overrun: name(pacer.pace().overrun),
        period: track.period.1,
        steps_per_period: track.steps,
        periods: report.tasks,
        deadline_held: report.held(),
        overruns: report.overruns,
        latest: report.latest.as_secs_f64(),
        jitter: times(report.jitter),
        duration: times(report.duration),
        margin: MarginSummary {
            least: report.margin.least,
            p1: report.margin.p1,
            p50: report.margin.p50,
        },
        real_time_factor: report.real_time_factor,
        elapsed: report.elapsed.as_secs_f64(),
        behind: report.behind.as_secs_f64(),
        skipped: report.skipped,
        degraded_periods: levels.iter().skip(1).map(|level| level.periods).sum(),
        levels: if track.has_level { levels } else { Vec::new() },
        log: report.log.iter().map(|entry| logged(entry, track.period.1)).collect(),
        log_left_out: report.log_left_out,
    }
}

fn logged(entry: &Entry, period: f64) -> Logged {
    let (action, next_level, held_periods) = match entry.action {
        Action::Finished => ("finished", entry.level, 0),
        Action::Held { periods } => ("held", entry.level, periods),
        Action::Down { to } => ("down", to, 0),
        Action::Up { to } => ("up", to, 0),
    };
    #[allow(clippy::cast_precision_loss, reason = "counts of periods stay far below 2^53")]
    let time = (entry.task + 1) as f64 * period;
    Logged {
        index: entry.task,
        time,
        at: entry.at.as_secs_f64(),
        duration: entry.duration.as_secs_f64(),
        late: entry.late.as_secs_f64(),
        level: entry.level,
        action,
        next_level,
        held_periods,
    }
}
