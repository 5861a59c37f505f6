//! Values of a parameter between the two ends of a range.

#![allow(clippy::float_cmp, reason = "values are exact decimals")]

use mbs_scene::inside::ValueRange;

const fn range(from: f64, to: f64, is_log: bool) -> ValueRange {
    ValueRange { from, to, is_log }
}

#[test]
fn ranges_are_the_decimals_that_a_person_would_write() {
    assert_eq!(
        range(0.0, 1.0, false).spread(11),
        [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
    );
    assert_eq!(range(1e3, 1e7, true).spread(5), [1e3, 1e4, 1e5, 1e6, 1e7]);
    assert_eq!(range(2.0, -2.0, false).spread(3), [2.0, 0.0, -2.0]);
    let tenths = range(0.1, 0.7, false);
    assert_eq!(tenths.steps(0.1), Some(7.0));
    assert_eq!(tenths.stepped(0.1, 7), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
}

#[test]
fn steps_stop_before_the_end_and_lead_nowhere_the_wrong_way() {
    assert_eq!(range(0.0, 1.0, false).steps(0.3), Some(4.0));
    for step in [-0.1, 0.0, 1.1, f64::NAN] {
        assert_eq!(range(0.0, 1.0, false).steps(step), None, "{step}");
    }
}

#[test]
fn every_stratum_has_one_sample() {
    // Number of intervals.
    const N: u32 = 500;
    for stream in 0..3 {
        let samples = range(0.0, f64::from(N), false).strata(N, 42, stream);
        let mut strata: Vec<i64> = samples.iter().map(|x| x.floor() as i64).collect();
        strata.sort_unstable();
        assert!(strata.into_iter().eq(0..i64::from(N)));
    }
}

#[test]
fn logarithmic_strata_are_equal_in_the_logarithm() {
    let samples = range(1.0, 1e8, true).strata(8, 7, 0);
    let mut decades: Vec<i64> = samples.iter().map(|x| x.log10().floor() as i64).collect();
    decades.sort_unstable();
    assert!(decades.into_iter().eq(0..8));
}

#[test]
fn a_seed_gives_the_same_numbers_for_ever() {
    let unit = range(0.0, 1.0, false);
    assert_eq!(unit.strata(4, 1, 0), unit.strata(4, 1, 0));
    assert_ne!(unit.strata(4, 1, 0), unit.strata(4, 1, 1), "parameters differ");
    assert_ne!(unit.strata(4, 1, 0), unit.strata(4, 2, 0), "seeds differ");
    assert_eq!(
        unit.strata(4, 1, 0),
        [0.973670765717351, 0.570366765570404, 0.124901993148397, 0.324573846340744]
    );
}
