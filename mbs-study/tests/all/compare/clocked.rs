//! Histogram classes and percentiles of step times.

use mbs_study::inside::compare::step_times;

#[test]
fn classes_count_every_step_and_percentiles_are_of_the_sorted_times() {
    let times = (1..=200).rev().map(|i| f64::from(i) * 1e-6).collect();
    let found = step_times(times, 0.0).unwrap();
    assert_eq!(found.classes.iter().map(|(_, n)| n).sum::<u64>(), 200);
    assert!((found.p50 - 1e-4).abs() < 1e-12 && (found.p99 - 1.98e-4).abs() < 1e-12);
    assert!((found.max - 2e-4).abs() < 1e-12);
    assert!(found.classes.windows(2).all(|pair| pair[0].0 < pair[1].0));
    assert_eq!(step_times(vec![], 0.0), None);
}
