//! Envelope of several runs: the smallest and the largest value of a column at each time.

use super::difference::value;
use super::read::ResultTable;

/// Returns the times of all runs that have a column, and the column's smallest and largest value at each of them. Values are linear between
/// the rows of a run, and a run counts from its first to its last row only. `None` means that no run has the column.
#[must_use]
pub fn envelope(runs: &[&ResultTable], name: &str) -> Option<[Vec<f64>; 3]> {
    let columns = runs.iter().filter_map(|run| Some((*run, run.column(name)?)));
    let columns: Vec<_> = columns.filter(|(run, _)| !run.times.is_empty()).collect();
    if columns.is_empty() {
        return None;
    }
    let mut times: Vec<f64> = columns.iter().flat_map(|(run, _)| &run.times).copied().collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let mut least = vec![f64::NAN; times.len()];
    let mut largest = least.clone();
    for (run, column) in columns {
        let (first, last, mut from) = (run.times[0], run.end(), 0);
        for (i, t) in times.iter().enumerate().filter(|(_, t)| (first..=last).contains(*t)) {
            let here = value(&run.times, &column.values, *t, &mut from);
            // `min` and `max` of a number and NaN are the number
            (least[i], largest[i]) = (least[i].min(here), largest[i].max(here));
        }
    }
    Some([times, least, largest])
}
