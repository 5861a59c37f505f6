//! Laws of guides: derivatives, splines and their ends.

use mbs_core::laws::guide::*;

/// Times [s] and values of knots with different distances.
const TABLE: [[f64; 2]; 5] = [[-1.0, 0.3], [0.0, 0.0], [0.5, -0.2], [1.7, 1.1], [2.0, 1.0]];

fn prepared() -> [f64; 5] {
    let (mut curvature, mut scratch) = ([0.0; 5], [0.0; 5]);
    spline_curvatures(&TABLE, &mut curvature, &mut scratch);
    curvature
}

/// Compares derivatives with central differences of step 1e-5: truncation is 1e-10 times a third derivative of order 100.
fn derivatives_match(g: impl Fn(f64) -> GuideMotion<f64>, t: f64) {
    let h = 1.0e-5;
    let (before, now, after) = (g(t - h), g(t), g(t + h));
    assert!(((after.value - before.value) / (2.0 * h) - now.rate).abs() < 1.0e-6, "t = {t}");
    let curvature = (after.rate - before.rate) / (2.0 * h);
    assert!((curvature - now.acceleration).abs() < 1.0e-5 * (1.0 + curvature.abs()), "t = {t}");
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let curvature = prepared();
    for i in 0..50 {
        let t = -0.99 + 0.0597 * f64::from(i);
        derivatives_match(|t| sine(0.7, 0.5, 0.3, t), t);
        derivatives_match(|t| ramp(-2.5, t), t);
        derivatives_match(|t| spline(&TABLE, &curvature, t), t);
    }
}

#[test]
fn spline_passes_through_its_rows_and_holds_its_ends() {
    let curvature = prepared();
    for [t, g] in TABLE {
        assert!((spline(&TABLE, &curvature, t).value - g).abs() < 1.0e-14);
    }
    assert_eq!(curvature[0].to_bits(), 0);
    assert_eq!(curvature[4].to_bits(), 0);
    let before = spline(&TABLE, &curvature, -3.0);
    assert_eq!(before, GuideMotion { value: 0.3, rate: 0.0, acceleration: 0.0 });
    assert_eq!(spline(&TABLE, &curvature, 9.0).value.to_bits(), 1.0_f64.to_bits());
}

#[test]
fn a_level_spline_is_at_rest_at_its_ends_and_smooth_within() {
    let (mut curvature, mut scratch) = ([0.0; 5], [0.0; 5]);
    level_curvatures(&TABLE, &mut curvature, &mut scratch);
    for [t, g] in TABLE {
        assert!((spline(&TABLE, &curvature, t).value - g).abs() < 1.0e-14);
    }
    for t in [-1.0, 2.0] {
        assert!(spline(&TABLE, &curvature, t).rate.abs() < 1.0e-14, "at {t}");
    }
    for i in 1..4 {
        let (t, h) = (TABLE[i][0], 1.0e-9);
        let [before, after] = [t - h, t + h].map(|t| spline(&TABLE, &curvature, t));
        assert!((before.rate - after.rate).abs() < 1.0e-7, "row {i}");
        assert!((before.acceleration - after.acceleration).abs() < 1.0e-6, "row {i}");
    }
    for i in 0..50 {
        derivatives_match(|t| spline(&TABLE, &curvature, t), -0.99 + 0.0597 * f64::from(i));
    }
}

#[test]
fn two_level_rows_are_the_cubic_from_rest_to_rest() {
    // g = 3 s² − 2 s³ during 2 s up to 0.6: the largest rate, in the middle, is 1.5 times the mean rate
    let table = [[1.0, 0.0], [3.0, 0.6]];
    let (mut curvature, mut scratch) = ([0.0; 2], [0.0; 2]);
    level_curvatures(&table, &mut curvature, &mut scratch);
    for i in 0..=10 {
        let s = 0.1 * f64::from(i);
        let found = spline(&table, &curvature, 1.0 + 2.0 * s);
        assert!((found.value - 0.6 * s * s * (3.0 - 2.0 * s)).abs() < 1.0e-15, "{s}");
    }
    assert!((largest_rate(&table, &curvature) - 0.45).abs() < 1.0e-15);
    let mut one = [1.0_f64];
    level_curvatures(&[[0.0, 2.0]], &mut one, &mut [0.0]);
    let rate: f64 = spline(&[[0.0, 2.0]], &one, 0.0).rate;
    assert_eq!(rate.to_bits(), 0);
}

#[test]
fn two_rows_are_a_straight_line_and_one_row_is_a_constant() {
    let table: [[f64; 2]; 2] = [[0.0, 0.0], [1.0, 0.05]];
    let (mut curvature, mut scratch) = ([1.0; 2], [0.0; 2]);
    spline_curvatures(&table, &mut curvature, &mut scratch);
    let middle = spline(&table, &curvature, 0.5);
    assert!((middle.value - 0.025).abs() < 1.0e-17 && (middle.rate - 0.05).abs() < 1.0e-17);
    let held = spline(&[[3.0, 2.0]], &[0.0], 0.0);
    assert_eq!(held, GuideMotion { value: 2.0, rate: 0.0, acceleration: 0.0 });
}
