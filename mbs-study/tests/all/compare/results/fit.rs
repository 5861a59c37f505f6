//! Orders by a fit of errors.

use mbs_study::inside::results::fit;

fn steps() -> impl Iterator<Item = f64> {
    (0..9).map(|k| 0.01 * f64::powi(0.5, k))
}

#[test]
fn a_power_law_has_its_power_and_all_points_are_used() {
    let points: Vec<_> = steps().map(|h| (h, 3.0 * h * h)).collect();
    let fit = fit(&points, 0.0).unwrap();
    assert!((fit.order.unwrap() - 2.0).abs() < 1e-12);
    assert_eq!((fit.points, fit.rounding_below), (9, None));
}

#[test]
fn rounding_is_found_where_errors_grow_again_and_does_not_bend_the_order() {
    let points: Vec<_> = steps().map(|h| (h, 3.0 * h * h + 1e-12 / (h * h))).collect();
    let fit = fit(&points, 0.0).unwrap();
    // at the shortest step on the line, 1.25e-3 s, rounding is an eighth of the error and changes the last slope by a tenth
    assert!((fit.order.unwrap() - 2.0).abs() < 0.1, "{fit:?}");
    // the rounding of 1e-12 equals the error 3 h^4 at the step h = 7.6e-4
    let below = fit.rounding_below.unwrap();
    assert!((6e-4..9e-4).contains(&below), "{below}");
}

#[test]
fn errors_that_have_lost_the_motion_or_that_the_reference_cannot_resolve_are_left_out() {
    let error = |h: f64| (3e4 * h * h).clamp(1e-4, 0.7);
    let points: Vec<_> = steps().map(|h| (h, error(h))).collect();
    let fit = fit(&points, 3e-4).unwrap();
    assert!((fit.order.unwrap() - 2.0).abs() < 1e-9, "{fit:?}");
    assert!(fit.points < 9 && fit.rounding_below.is_none());
}

#[test]
fn steps_that_the_results_hold_have_no_order_and_no_number_that_is_none() {
    let held = [(1e-2, 1.4e-6), (1e-2, 1.3e-6), (1e-2, 1.2e-6), (9e-3, 1.1e-6)];
    assert_eq!(fit(&held, 0.0).unwrap().order, None);
    let near = [(1e-2, 1e-6), (8e-3, 6.4e-7), (6e-3, 3.6e-7)];
    assert_eq!(fit(&near, 0.0).unwrap().order, None, "three steps within a factor of two");
}

#[test]
fn scatter_has_no_order() {
    let points = [(1e-2, 1e-3), (5e-3, 9e-4), (2.5e-3, 1e-5), (1.2e-3, 9e-6)];
    assert_eq!(fit(&points, 0.0).unwrap().order, None);
    assert_eq!(fit(&[], 0.0), None);
}
