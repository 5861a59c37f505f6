//! Curves of one number: derivatives, changes, and periodic splines.

use mbs_core::measure::PreparedCurve;
use mbs_core::scene::Curve;

#[test]
fn periodic_spline_has_equal_slopes_and_curvatures_where_its_pieces_meet() {
    let knots = |n: usize| -> Vec<[f64; 2]> {
        let x = |i: usize| 0.3 + (i as f64) * 6.0 / n as f64 + 0.1 * ((i % n) as f64 * 0.7).sin();
        let f = |i: usize| 0.2 * ((i % n) as f64 * 2.3).sin();
        (0..=n).map(|i| [x(i), f(i)]).collect()
    };
    for n in [2, 3, 4, 7, 20] {
        let knots = knots(n);
        let curve = PreparedCurve::new(Some(&Curve::Periodic(knots.clone())));
        let period = knots[n][0] - knots[0][0];
        for knot in &knots {
            let e = 1e-7;
            let [left, right] = [curve.at(knot[0] - e), curve.at(knot[0] + e)];
            assert!((left[1] - right[1]).abs() < 1e-5, "{n}: {left:?} {right:?}");
            assert!((left[2] - right[2]).abs() < 1e-4, "{n}: {left:?} {right:?}");
            assert!((curve.at(knot[0] + 3.0 * period)[0] - knot[1]).abs() < 1e-13);
        }
    }
}

#[test]
fn changes_of_curves_are_differences_of_their_values() {
    let curves = [
        Curve::Polynomial(vec![0.3, -1.0, 0.5, 2.0]),
        Curve::Table(vec![[0.0, 0.0], [1.0, 0.4], [1.5, -0.3], [4.0, 1.0]]),
        Curve::Periodic(vec![[0.0, 0.0], [1.0, 0.4], [1.5, -0.3], [4.0, 0.0]]),
    ];
    for curve in curves.map(|curve| PreparedCurve::new(Some(&curve))) {
        for i in -40..60 {
            let x = 0.11 * f64::from(i);
            for dx in [-3.7, -0.6, -1e-3, 0.0, 1e-3, 0.5, 2.9, 4.0] {
                let expected = curve.at(x + dx)[0] - curve.at(x)[0];
                let found = curve.change(x, dx);
                // values are of order ten, for the polynomial a hundred
                let size = curve.at(x)[0].abs().max(curve.at(x + dx)[0].abs()).max(1.0);
                assert!((found - expected).abs() < 1e-13 * size, "{curve:?}: {x} {dx}");
            }
            let slope = curve.at(x + 1e-20)[1];
            let is_held = slope == 0.0;
            // a change far below the rounding of x
            let found = curve.change(x, 1e-20);
            assert!(is_held || (found / 1e-20 - slope).abs() < 1e-9 * slope.abs().max(1.0));
        }
    }
}

#[test]
fn derivatives_of_curves_are_their_difference_quotients() {
    let curves = [
        Curve::Polynomial(vec![0.3, -1.0, 0.5, 2.0]),
        Curve::Table(vec![[0.0, 0.0], [1.0, 0.4], [1.5, -0.3], [4.0, 1.0]]),
        Curve::Periodic(vec![[0.0, 0.0], [1.0, 0.4], [1.5, -0.3], [4.0, 0.0]]),
    ];
    for curve in curves.map(|curve| PreparedCurve::new(Some(&curve))) {
        for x in [0.2, 0.9, 1.2, 2.0, 3.7] {
            let e = 1e-5_f64;
            let [a, b, at] = [curve.at(x - e), curve.at(x + e), curve.at(x)];
            // the error of a central difference is e^2 f''' / 6, plus rounding over e
            assert!(((b[0] - a[0]) / (2.0 * e) - at[1]).abs() < 1e-8, "{curve:?} at {x}");
            assert!(((b[1] - a[1]) / (2.0 * e) - at[2]).abs() < 1e-8, "{curve:?} at {x}");
        }
    }
}
