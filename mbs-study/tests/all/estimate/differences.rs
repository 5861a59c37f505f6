//! Errors estimated from the rows of a run.

use mbs_study::inside::{GROWTH, errors};

#[test]
fn the_phase_error_of_an_oscillation_is_met_within_a_factor_of_two_of_the_growth() {
    // the trapezoidal rule lowers the frequency of x'' = -x by h²/12, which gives a phase error of 100 h²/12 after 100 s
    let h = 0.1;
    let row = |i: i32| (f64::from(i) * h, vec![(f64::from(i) * h).cos()]);
    let rows: Vec<_> = (0..=1000).map(row).collect();
    let error = 100.0 * h * h / 12.0;
    let [estimate] = errors(&rows)[..] else { panic!() };
    assert!(estimate > error && estimate < 2.0 * GROWTH * error, "{estimate} for {error}");
}
