//! What several runs have between them: the least and the largest value of a column at each time.

use super::difference::value;
use super::read::ResultTable;

/// The times of all runs that have a column, and its least and its largest value at them, linear between the rows of a run. A run counts
/// from its first to its last row. `None` where no run has it.
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
            // a number beside NaN is the number
            (least[i], largest[i]) = (least[i].min(here), largest[i].max(here));
        }
    }
    Some([times, least, largest])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::ResultColumn;

    fn run(times: &[f64], values: &[f64]) -> ResultTable {
        let column = ResultColumn { name: "x".into(), values: values.into(), ..Default::default() };
        ResultTable { times: times.into(), columns: vec![column], ..ResultTable::default() }
    }

    #[test]
    fn an_envelope_is_linear_between_rows_and_ends_of_single_runs_end_their_part() {
        let (rising, falling) = (run(&[0.0, 2.0], &[0.0, 2.0]), run(&[0.0, 1.0], &[1.0, 0.0]));
        let found = envelope(&[&rising, &falling], "x").expect("both have it");
        assert_eq!(found, [vec![0.0, 1.0, 2.0], vec![0.0, 0.0, 2.0], vec![1.0, 1.0, 2.0]]);
        assert_eq!(envelope(&[&rising], "y"), None);
    }
}
