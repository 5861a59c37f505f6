//! Singular positions between samples.

use mbs_study::inside::refined;

fn least(kappa: impl Fn(f64) -> f64) -> [f64; 2] {
    let kappa: Vec<[f64; 2]> = (0..21).map(|i| f64::from(i) * 0.1).map(|t| [t, kappa(t)]).collect();
    let i = (0..21).min_by(|&a, &b| kappa[a][1].total_cmp(&kappa[b][1])).expect("samples");
    refined(&kappa, i)
}

#[test]
fn a_passage_between_samples_is_found_where_it_is() {
    for at in [0.737, 0.75, 0.8, 0.799, 1.03] {
        let [t, value] = least(|t| (t - at).sin().abs());
        // the limits cover the deviation of a cubic through samples that are 0.1 apart, (2 0.1)^4 / 24, and that of the slope of a chord,
        // (0.1)^2 / 6
        assert!((t - at).abs() < 2e-3 && value < 1e-4, "{t} {value}");
    }
}

#[test]
fn a_near_miss_is_no_passage() {
    let [t, value] = least(|t| (t - 0.737).hypot(0.05));
    // κ² is a parabola here, so its minimum is exact
    assert!((t - 0.737).abs() < 1e-12 && (value - 0.05).abs() < 1e-12, "{t} {value}");
}
