//! Texts about a paced run: the rows of its summary, and a note.

use crate::record::{Degraded, RealtimeSummary};
use mbs_scene::format::significant;
use mbs_scene::format::{duration, few};

/// Rows of the summary of a paced run, each with label and value.
#[must_use]
pub fn rows(s: &RealtimeSummary) -> Vec<(&'static str, String)> {
    let spread = |of: &crate::record::Times| {
        let [p50, p99, max] = [of.p50, of.p99, of.max].map(duration);
        format!("{p50}, {p99}, {max}")
    };
    let mut rows = vec![
        ("deadline", deadline(s)),
        ("begin late p50, p99, max", spread(&s.jitter)),
        ("computed p50, p99, max", spread(&s.duration)),
        (
            "left p50, p1, least",
            format!(
                "{}, {}, {}",
                signed(s.margin.p50),
                signed(s.margin.p1),
                signed(s.margin.least)
            ),
        ),
    ];
    if s.behind > 0.0 {
        rows.push(("behind the clock", duration(s.behind)));
    }
    rows.extend(s.levels.iter().map(|level| ("level", level_text(level))));
    rows
}

/// Formats whether the deadlines were met, and the action after a missed deadline.
fn deadline(s: &RealtimeSummary) -> String {
    let of = format!("{} periods of {} s", s.periods, significant(s.period));
    if s.deadline_held {
        return format!("held in {of} ({})", s.overrun);
    }
    format!("missed in {} of {of} ({}), by at most {}", s.overruns, s.overrun, duration(s.latest))
}

/// Formats a time [s] that may be negative.
fn signed(seconds: f64) -> String {
    if seconds < 0.0 { format!("-{}", duration(-seconds)) } else { duration(seconds) }
}

/// Formats a level of degradation.
fn level_text(level: &Degraded) -> String {
    let mut text = format!("{}: ", level.level);
    let longer = level.step_times > 1.0;
    if longer {
        text += &format!("steps {} times as long", few(level.step_times));
    }
    if !level.without.is_empty() {
        let joint = if longer { ", " } else { "" };
        text += &format!("{joint}without {}", level.without.join(", "));
    }
    if !longer && level.without.is_empty() {
        text += "everything";
    }
    if let Some(saves) = level.saves {
        let over = level
            .measured_over
            .map_or_else(String::new, |t| format!(" over the first {} s", few(t)));
        text += &format!("; saves {} %{over}", few(100.0 * saves));
    }
    if let (Some(changes), Some(output)) = (level.changes, &level.output) {
        text += &format!(", changes `{output}` most, by {} % of its range", few(100.0 * changes));
    }
    let n = level.periods;
    text + &format!("; {n} {}", if n == 1 { "period" } else { "periods" })
}

/// Returns a note on a run that was degraded; `None` if it was not.
pub fn note(s: &RealtimeSummary) -> Option<String> {
    (s.degraded_periods > 0).then(|| {
        format!(
            "{} of {} periods were degraded: their results are not those of the full scene; column `realtime-level` marks them",
            s.degraded_periods, s.periods
        )
    })
}
