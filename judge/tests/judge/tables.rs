//! Tables without overshoot between their rows.

use judge::scene::Spline;

#[test]
fn from_rest_to_rest_the_third_derivative_has_one_size_throughout() {
    let rows = [[0.0, 0.0], [1.0, 0.0], [2.0, 10.0], [3.0, 10.0]];
    let table = Spline::monotone(&Spline::natural(&rows), false);
    // f''' is 32 D/h³ = 320 over a quarter of the interval, then -320 over a half, with D = 10 and h = 1
    for (x, right) in [
        (0.5, [0.0, 0.0, 0.0]),
        (1.25, [320.0 / 384.0, 10.0, 80.0]),
        (1.5, [5.0, 20.0, 0.0]),
        (1.75, [10.0 - 320.0 / 384.0, 10.0, -80.0]),
        (2.5, [10.0, 0.0, 0.0]),
    ] {
        let found = table.at(x);
        let off = (0..3).map(|k| (found[k] - right[k]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-12, "{x}: {found:?}, {right:?}");
    }
}

#[test]
fn a_table_whose_spline_stays_between_its_rows_is_the_spline() {
    let rows = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.2], [3.5, 4.0]];
    let spline = Spline::natural(&rows);
    assert_eq!(Spline::monotone(&spline, false).knots, spline.knots);
}
