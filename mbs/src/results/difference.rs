//! Differences of two runs, column by column.
//!
//! ```text
//! d = max |a(t) - b(t)|    over the times of both, a and b linear between rows
//! ```
//!
//! The difference of two piecewise linear functions is piecewise linear too. Its corners are at the times of the rows of both runs, so its
//! largest magnitude is at one of these times.

use super::read::{ResultColumn, ResultTable};

/// Difference that counts as zero, relative to the largest value of a channel [-]. A constant channel has no range that its rounding errors
/// could be compared with.
const ROUNDING: f64 = 1e-12;
/// Difference of the end times of two runs that counts as zero, relative to these times [-]. An end time is a rounded sum of steps.
const SAME_END: f64 = 1e-9;

/// Difference of a column between two runs.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct ColumnDifference {
    /// Name of the column.
    pub name: String,
    /// Unit of the column.
    pub unit: String,
    /// Largest magnitude in each run.
    pub peaks: [f64; 2],
    /// Root mean square in each run.
    pub rms: [f64; 2],
    /// Largest difference of the two runs.
    pub difference: f64,
    /// Time of the largest difference [s].
    pub at: f64,
    /// Range of the channel: the largest range of its components that have this unit, in both runs.
    pub range: f64,
    /// Largest difference divided by the range [-].
    pub relative: f64,
}

/// Difference of two runs.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize)]
pub struct Difference {
    /// Columns that both runs have.
    pub columns: Vec<ColumnDifference>,
    /// Channels that only the first run has.
    pub only_a: Vec<String>,
    /// Channels that only the second run has.
    pub only_b: Vec<String>,
    /// End time of each run [s].
    pub ends: [f64; 2],
}

impl Difference {
    /// True if both runs end at the same time and each column's largest difference is at most `within` times its range.
    #[must_use]
    pub fn is_within(&self, within: f64) -> bool {
        self.ends_together() && self.columns.iter().all(|column| column.relative <= within)
    }

    /// True if both runs end at the same time.
    #[must_use]
    pub fn ends_together(&self) -> bool {
        let [a, b] = self.ends;
        (a - b).abs() <= SAME_END * a.abs().max(b.abs())
    }
}

/// Compares two runs in the channels or columns of the given names. An empty list selects all channels.
#[must_use]
pub fn difference(a: &ResultTable, b: &ResultTable, names: &[String]) -> Difference {
    let is_asked = |column: &&ResultColumn| {
        names.is_empty() || names.iter().any(|x| *x == column.channel || *x == column.name)
    };
    let both = a.columns.iter().filter(is_asked);
    let both = both.filter_map(|column| Some((column, b.column(&column.name)?)));
    let columns = both.map(|(x, y)| of_columns((a, x), (b, y))).collect();
    let only = |one: &ResultTable, other: &ResultTable| {
        let missing = |column: &&ResultColumn| other.column(&column.name).is_none();
        let missing = one.columns.iter().filter(is_asked).filter(missing);
        let mut names: Vec<_> = missing.map(|column| column.channel.clone()).collect();
        names.dedup();
        names
    };
    Difference { columns, only_a: only(a, b), only_b: only(b, a), ends: [a.end(), b.end()] }
}

/// Subtracts the second run from the first in a column that both have. Returns times and differences.
#[must_use]
pub fn difference_over_time(a: &ResultTable, b: &ResultTable, name: &str) -> Option<[Vec<f64>; 2]> {
    let rows = rows((a, a.column(name)?), (b, b.column(name)?));
    let (times, values) = rows.into_iter().unzip();
    Some([times, values])
}

/// Returns the times of the span that both runs cover, each with the value of the first run minus that of the second.
fn rows(
    (a, x): (&ResultTable, &ResultColumn),
    (b, y): (&ResultTable, &ResultColumn),
) -> Vec<(f64, f64)> {
    let span = a.times[0].max(b.times[0])..=a.end().min(b.end());
    let times = a.times.iter().chain(&b.times).filter(|t| span.contains(t));
    let mut times: Vec<f64> = times.copied().collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let (mut i, mut j) = (0, 0);
    let difference =
        |t: f64| value(&a.times, &x.values, t, &mut i) - value(&b.times, &y.values, t, &mut j);
    let differences: Vec<f64> = times.iter().copied().map(difference).collect();
    times.into_iter().zip(differences).collect()
}

fn of_columns(
    (a, x): (&ResultTable, &ResultColumn),
    (b, y): (&ResultTable, &ResultColumn),
) -> ColumnDifference {
    let (mut difference, mut at) = (0.0, a.times[0].max(b.times[0]));
    for (t, here) in rows((a, x), (b, y)) {
        if here.abs() > difference {
            (difference, at) = (here.abs(), t);
        }
    }
    let [of_a, of_b] = [(a, x), (b, y)].map(|(table, column)| scale(table, column));
    let range = of_a[0].max(of_b[0]);
    let floor = ROUNDING * of_a[1].max(of_b[1]);
    let relative = match difference <= floor {
        true => 0.0,
        false => difference / range.max(floor),
    };
    ColumnDifference {
        name: x.name.clone(),
        unit: x.unit.clone(),
        peaks: [x.peak, y.peak],
        rms: [x.rms, y.rms],
        difference,
        at,
        range,
        relative,
    }
}

/// Returns the largest range and the largest magnitude among the columns of a channel that have the unit of `of`.
fn scale(table: &ResultTable, of: &ResultColumn) -> [f64; 2] {
    let same = table.columns.iter().filter(|x| x.channel == of.channel && x.unit == of.unit);
    same.fold([0.0; 2], |[range, size], column| {
        let least = column.values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = column.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        [range.max(most - least), size.max(most.abs()).max(least.abs())]
    })
}

/// Returns the value at time `t`, linear between the rows. `from` is the row where the last search ended; successive times must not decrease.
pub(super) fn value(times: &[f64], values: &[f64], t: f64, from: &mut usize) -> f64 {
    while *from + 1 < times.len() && times[*from + 1] <= t {
        *from += 1;
    }
    let i = *from;
    if i + 1 == times.len() || t <= times[i] {
        return values[i];
    }
    let share = (t - times[i]) / (times[i + 1] - times[i]);
    values[i] + share * (values[i + 1] - values[i])
}
