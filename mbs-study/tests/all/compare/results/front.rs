//! CPU times at an error, between two runs.

use mbs_study::inside::results::{at_error, beside};

#[test]
fn times_are_interpolated_between_the_runs_beside_the_error() {
    // a run with steps h has an error of h^2 and takes a time of 1/h
    let points: Vec<(f64, [f64; 1])> = [1e-1, 1e-2, 1e-3].map(|h| (h * h, [1.0 / h])).to_vec();
    let [t] = at_error(&points, 1e-5, |_, _| true).unwrap();
    assert!((t - 10.0 * f64::sqrt(10.0) * 10.0).abs() < 1e-9 * t, "{t}");
    let [t] = at_error(&points, 0.5, |_, _| true).unwrap();
    assert!((t - 10.0).abs() < 1e-9, "the coarsest run reaches it: {t}");
    let [t] = at_error(&points, 1e-5, |_, _| false).unwrap();
    assert!((t - 1000.0).abs() < 1e-9, "nothing lies between the runs: {t}");
    assert_eq!(at_error(&points, 1e-7, |_, _| true), None);
}

#[test]
fn an_error_that_is_small_by_luck_counts_for_nothing() {
    // the second run has a smaller error than its neighbours by chance; rounding begins to dominate in the last two
    let errors = [1e-1, 1e-5, 2e-2, 1e-3, 1e-4, 2e-4];
    let of = |level| beside(&errors, level).map(|b| (b.misses, b.reaches));
    assert_eq!(of(1e-2), Some((Some(1), 3)));
    assert_eq!(of(3e-4), Some((Some(3), 4)));
    assert_eq!(of(1.5e-4), None);
    assert_eq!(of(0.5), Some((None, 0)));
    let [t] = at_error(&[(1e-2, [1.0]), (0.0, [3.0])], 1e-3, |_, _| true).unwrap();
    assert!((t - 3.0).abs() < 1e-12);
}
