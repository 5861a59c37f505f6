//! Sections before the motion on the page of a real-time run: margins and the ladder of levels.

use super::section::PageSection;
use crate::table::Section;
use mbs::record::{Degraded, RealtimeSummary};
use mbs_scene::format::{duration, few};

/// Index of the column with bars in the table of the ladder: the fraction of the periods at each level.
const PERIODS: usize = 3;

/// Returns the sections on the deadline, on the margins, and on the levels of the run.
pub(super) fn sections(paced: &RealtimeSummary) -> Vec<PageSection> {
    let held = match paced.overruns {
        0 => format!("held in all {} periods", paced.periods),
        n => format!("missed in {n} of {} periods", paced.periods),
    };
    let cards = [
        ("deadline", held),
        ("period", duration(paced.period)),
        ("least margin", signed(paced.margin.least)),
        ("times faster than the clock", few(paced.real_time_factor)),
    ];
    let mut sections = vec![
        PageSection::Cards(cards.map(|(k, v)| [k.to_owned(), v]).into()),
        PageSection::Table(margins(paced)),
    ];
    if !paced.levels.is_empty() {
        sections.push(PageSection::Table(ladder(&paced.levels)));
    }
    sections
}

fn margins(paced: &RealtimeSummary) -> Section {
    let row = |name: &str, times: [f64; 3]| {
        let mut row = vec![name.to_owned()];
        row.extend(times.map(signed));
        row
    };
    let (jitter, computed, margin) = (paced.jitter, paced.duration, paced.margin);
    let rows = vec![
        row("left until the deadline", [margin.p50, margin.p1, margin.least]),
        row("computation of a period", [computed.p50, computed.p99, computed.max]),
        row("late begin", [jitter.p50, jitter.p99, jitter.max]),
    ];
    let head = ["", "median", "99 of 100 are better", "worst"];
    let mut table = Section::new("Margins", &head, rows);
    let (n, period) = (paced.periods, duration(paced.period));
    table.caption =
        format!("Over {n} periods of {period}. A negative time is behind the deadline.");
    table
}

fn ladder(levels: &[Degraded]) -> Section {
    let share =
        |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{}\u{a0}%", few(100.0 * x)));
    let row = |level: &Degraded| {
        let without = match level.without.as_slice() {
            [] => "nothing".to_owned(),
            names => names.join(", "),
        };
        let changes = match &level.output {
            Some(output) => format!("{} of {output}", share(level.changes)),
            None => share(level.changes),
        };
        vec![
            level.level.to_string(),
            few(level.step_times),
            without,
            level.periods.to_string(),
            share(level.saves),
            changes,
        ]
    };
    let head =
        ["level", "times the step", "left out", "periods", "saves CPU time", "changes at most"];
    let mut table = Section::new("Ladder", &head, levels.iter().map(row).collect());
    let all = levels.iter().map(|level| level.periods).sum::<u64>().max(1);
    let length = |level: &Degraded| level.periods as f64 / all as f64;
    table.bars = Some((PERIODS, levels.iter().map(length).collect()));
    table.caption =
        "Level 0 is the full scene; results of other levels are not those of the full scene. Savings, and the largest change of an output relative \
         to its range, are those measured before the run."
            .to_owned();
    table
}

/// Formats a time, which may be negative, without a line break.
fn signed(t: f64) -> String {
    let time = if t < 0.0 { format!("-{}", duration(-t)) } else { duration(t) };
    time.replace(' ', "\u{a0}")
}
