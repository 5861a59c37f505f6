//! Steps, tolerances and instants of a comparison.

use mbs_study::inside::compare::{Instants, steps, tolerances};

#[test]
fn default_steps_fit_between_the_instants() {
    for (duration, step) in [(10.0, 1e-3), (0.03, 1e-5), (6.0, 1e-3), (10.0, 5e-3), (1.0, 1e-2)] {
        let steps = steps(&[], step, duration);
        let instants = Instants::new(duration, &steps);
        assert!((10..=200).contains(&instants.count), "{instants:?}");
        for h in steps {
            let n = instants.steps_between(h) as f64;
            assert!((n * h - instants.interval).abs() < 1e-9 * duration, "{h} {instants:?}");
        }
    }
}

#[test]
fn steps_that_do_not_fit_are_brought_to_the_nearest_that_do() {
    let instants = Instants::new(1.0, &[0.03, 0.007]);
    let h = instants.interval / instants.steps_between(0.007) as f64;
    assert!((h - 0.007).abs() < 0.001, "{h}");
    assert_eq!(Instants::new(1.0, &[1.0]).count, 1);
}

#[test]
fn what_is_asked_for_is_run_from_the_coarsest() {
    assert_eq!(steps(&[1e-3, 1e-2, 1e-3], 0.1, 1.0), [1e-2, 1e-3]);
    assert_eq!(tolerances(&[1e-6, 1e-3]), [1e-3, 1e-6]);
    assert_eq!(steps(&[], 1.0, 2.0), [0.125, 0.0625, 0.03125]);
}
