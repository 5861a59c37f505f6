//! Diagram of error over time for every method of a table.

use super::report::Table;
use super::rows::Row;
use crate::chart::{Chart, Look, Series};

/// Caption of the drawing.
pub(crate) const CAPTION: &str = "Ours, from the rows above: CPU time of the stepping over the largest energy error, a mark for each step; \
    further to the lower left is better. What stopped has no mark: its reason stands in the table.";

/// The drawing of a table; `None` if fewer than two errors can be shown.
pub(crate) fn chart(table: &Table, rows: &[Row]) -> Option<Chart> {
    let points = |name: &str| -> Vec<[f64; 2]> {
        let these = rows.iter().filter(|row| row.method.name == name);
        these.filter_map(|row| row.outcome.figures()).map(|f| [f.energy_error, f.seconds]).collect()
    };
    let series = table.methods.iter().enumerate();
    let series = series.map(|(i, m)| Series::new(m.name, i, Look::Both, points(m.name)));
    let series: Vec<_> = series.collect();
    let n = series.iter().flat_map(|s| &s.points).count();
    (n > 1).then(|| Chart::log_log("largest energy error [J]", "CPU [s]", series))
}

#[cfg(test)]
mod tests {
    use super::super::rows::tests::samples;
    use super::*;

    #[test]
    fn a_table_with_one_result_is_not_drawn_and_with_two_is() {
        let mut rows = samples()[..1].to_vec();
        let table = rows[0].table;
        assert!(chart(table, &rows).is_none());
        rows.push(rows[0].clone());
        let chart = chart(table, &rows).unwrap();
        assert_eq!(chart.series.iter().map(|s| s.points.len()).sum::<usize>(), 2);
        assert_eq!(chart.series.len(), table.methods.len());
    }
}
