//! Differences of short runs, computed by hand.
#![allow(clippy::float_cmp, reason = "all numbers are exact in binary")]

mod envelope;

use mbs::results::{ResultColumn, ResultTable, difference};

fn table(times: &[f64], columns: &[(&str, &str, &[f64])]) -> ResultTable {
    let column = |&(channel, label, values): &(&str, &str, &[f64])| ResultColumn {
        name: format!("{channel}{label}"),
        channel: channel.into(),
        unit: "m".into(),
        values: values.to_vec(),
        ..ResultColumn::default()
    };
    let columns = columns.iter().map(column).collect();
    ResultTable { scene: String::new(), times: times.to_vec(), columns }
}

#[test]
fn the_largest_difference_is_at_a_row_of_either_run() {
    // a rises linearly from 0 to 2; b has corners at 0.5 and at 1.5
    let a = table(&[0.0, 2.0], &[("x", "", &[0.0, 2.0])]);
    let b = table(&[0.0, 0.5, 1.5, 2.0], &[("x", "", &[0.0, 1.0, 1.0, 2.0])]);
    let found = &difference(&a, &b, &[]).columns[0];
    assert_eq!([found.difference, found.at, found.range, found.relative], [0.5, 0.5, 2.0, 0.25]);
    let turned = &difference(&b, &a, &[]).columns[0];
    assert_eq!([turned.difference, turned.at], [0.5, 0.5]);
}

#[test]
fn components_share_the_range_of_their_channel() {
    // the second component is constant except for rounding, which must not count as a large relative difference
    let a = table(&[0.0, 1.0], &[("x", ".x", &[0.0, 4.0]), ("x", ".y", &[0.0, 1.0e-17])]);
    let b = table(&[0.0, 1.0], &[("x", ".x", &[0.0, 4.0]), ("x", ".y", &[0.0, -1.0e-17])]);
    let found = difference(&a, &b, &[]);
    assert!(found.is_within(0.0) && found.columns[1].difference > 0.0, "{found:?}");
    // for a channel without a range, the difference is relative to its size
    let [a, b] = [5.0, 5.0 + 1.0e-14].map(|x| table(&[0.0, 1.0], &[("x", "", &[x, x])]));
    assert!(difference(&a, &b, &[]).is_within(0.0));
    let b = table(&[0.0, 1.0], &[("x", "", &[5.1, 5.1])]);
    assert!(!difference(&a, &b, &[]).is_within(0.5));
}

#[test]
fn what_one_run_alone_has_is_named_and_runs_of_other_lengths_differ() {
    let a = table(&[0.0, 1.0], &[("x", "", &[0.0, 1.0]), ("y", ".1", &[0.0, 1.0])]);
    let b = table(&[0.0, 1.0, 2.0], &[("z", "", &[0.0; 3]), ("x", "", &[0.0, 1.0, 9.0])]);
    let found = difference(&a, &b, &[]);
    assert_eq!((found.only_a.clone(), found.only_b.clone()), (vec!["y".into()], vec!["z".into()]));
    // runs are compared over the time that both cover
    assert_eq!(found.columns[0].relative, 0.0);
    assert!(!found.is_within(1.0) && !found.ends_together());
    assert_eq!(difference(&a, &b, &["y".to_owned()]).columns, []);
}
