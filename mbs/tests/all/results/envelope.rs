//! Envelopes of the results of runs.

use mbs::results::ResultColumn;
use mbs::results::{ResultTable, envelope};

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
