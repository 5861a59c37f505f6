//! Table of statistics on the page of a run.

use super::section::PageSection;
use crate::table::Section;
use mbs::record::ChannelSeries;
use mbs::scene_file::format::significant;

/// Largest number of rows of the table that are shown without folding [-]. They fill the height of a screen. Chosen, not tuned.
const MAX_OPEN: usize = 24;
/// Number of digits of a time in the table [-]. They resolve a thousandth of a percent of a run.
const TIME_DIGITS: usize = 5;

/// Returns the table of extremes with their times, and of root mean squares, for all channels. A long table is folded.
pub(super) fn section(channels: &[ChannelSeries]) -> Option<PageSection> {
    let rows: Vec<_> = channels.iter().flat_map(rows).collect();
    let n = rows.len();
    if n == 0 {
        return None;
    }
    let head = ["output", "unit", "min", "at [s]", "max", "at [s]", "RMS", "end"];
    let mut table = Section::new("Statistics", &head, rows);
    table.caption =
        "Over every step, rows or not. Peaks lie between steps where their neighbours agree on one. RMS is the root of the mean square over time."
            .to_owned();
    let table = PageSection::Table(table);
    Some(if n > MAX_OPEN {
        PageSection::Fold(format!("Statistics of {n} numbers"), vec![table])
    } else {
        table
    })
}

fn rows(series: &ChannelSeries) -> impl Iterator<Item = Vec<String>> + '_ {
    let time = |t: f64| mbs::scene_file::format::rounded(t, TIME_DIGITS).to_string();
    series.stats.iter().map(move |one| {
        let name = match one.label.as_str() {
            "" => series.channel.name.clone(),
            label => format!("{}.{label}", series.channel.name),
        };
        let of = &one.of;
        vec![
            name,
            one.unit.clone(),
            significant(of.min),
            time(of.at_min),
            significant(of.max),
            time(of.at_max),
            significant(of.rms),
            significant(of.end),
        ]
    })
}
