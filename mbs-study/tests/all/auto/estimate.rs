//! Predictions of cost and error by power laws.

use mbs_study::inside::auto::{Basis, Point, PowerLaw, predict};

const SECOND: PowerLaw = PowerLaw { error: 2.0, cost: 1.0 };

fn points(settings: &[f64]) -> Vec<Point> {
    let of =
        |&h: &f64| Point { setting: h, error: h * h, seconds: 1e-3 / h, steps: (10.0 / h) as u64 };
    settings.iter().map(of).collect()
}

#[test]
fn a_method_that_keeps_its_law_is_predicted_exactly_on_either_side_of_its_trials() {
    let near = |found: f64, claimed: f64| (found / claimed - 1.0).abs() < 1e-9;
    for (error, is_between) in [(1e-5, false), (1e-3, true), (0.5e-1, false)] {
        let found = predict(SECOND, &points(&[0.1, 0.01]), error, 1.0).unwrap();
        let h = f64::sqrt(error);
        assert!(near(found.setting, h) && near(found.seconds, 1e-3 / h), "{found:?}");
        assert!(near(found.error, error) && (found.basis == Basis::Between) == is_between);
    }
    assert_eq!(predict(SECOND, &[], 1e-3, 1.0), None);
}

#[test]
fn no_setting_is_coarser_than_the_coarsest() {
    let found = predict(SECOND, &points(&[0.1]), 0.5, 0.1).unwrap();
    assert_eq!((found.basis, found.setting), (Basis::Tried, 0.1));
    let found = predict(SECOND, &points(&[0.1]), 0.5, 0.2).unwrap();
    assert!((found.error - 0.04).abs() < 1e-9, "{found:?}");
}

#[test]
fn exponents_are_taken_near_those_of_theory() {
    let mut lost = points(&[0.1, 0.05]);
    lost[1].error = lost[0].error;
    // an error that does not decrease is extrapolated with half of the order
    let found = predict(SECOND, &lost, 1e-4, 1.0).unwrap();
    assert!((found.setting / (0.05 * 1e-2) - 1.0).abs() < 1e-9, "{found:?}");
}
