//! Scales of outputs, and distances of rows by them.

use mbs::record::Channel;
use mbs_core::outputs::Component;
use mbs_study::compare::results::{output_scales, row_distance};
use mbs_study::inside::results::FLOOR;

fn channel(name: &str, units: &[&str]) -> Channel {
    let component = |unit: &&str| Component { label: String::new(), unit: (*unit).to_owned() };
    let components = units.iter().map(component).collect();
    Channel { name: name.to_owned(), quantity: "", components }
}

#[test]
fn components_of_a_unit_share_the_largest_range_and_what_stands_still_has_a_floor() {
    // an energy error is an output of the run, not of the motion
    let error = Channel { quantity: "invariant-error", ..channel("error", &["m"]) };
    let [tip, post, f] =
        [("tip", &["m", "m"][..]), ("post", &["m"]), ("f", &["N"])].map(|(a, b)| channel(a, b));
    let channels = [tip, post, f, error];
    let rows = vec![vec![0.0, 1.0, 7.0, 0.0, 0.0], vec![4.0, 2.0, 7.0, 0.0, 9e9]];
    let scales = output_scales(&channels, &rows, 0.5);
    let sizes: Vec<_> = scales.iter().map(|s| s.scale).collect();
    assert_eq!(sizes, [Some(4.0), Some(FLOOR * 4.0), None, None]);
    assert_eq!(scales[0].columns, [0, 1]);
    let [largest, rms] = row_distance(&scales, &rows[0], &[0.4, 1.0, 7.0, 9.0, 1.0]);
    assert!((largest - 0.1).abs() < 1e-12 && (rms - 0.1 / f64::sqrt(3.0)).abs() < 1e-12);
    assert!(row_distance(&scales, &rows[0], &[0.4, f64::NAN, 7.0, 9.0, 1.0])[0].is_nan());
}

#[test]
fn degrees_have_the_scales_of_radians() {
    let n = 180.0 / core::f64::consts::PI;
    let both = |units: [&str; 3], n: f64| {
        let channels = [("swing", units[0]), ("still", units[1]), ("rate", units[2])];
        let channels = channels.map(|(name, unit)| channel(name, &[unit]));
        output_scales(&channels, &[vec![0.0; 3], vec![4.0 * n, 0.0, 3.0]], 0.5)
    };
    let radians = both(["rad", "rad", "rad/s"], 1.0);
    // one of the two angles is in degrees, or both are
    for (units, of_still) in [(["deg", "rad", "rad/s"], 1.0), (["deg", "deg", "rad/s"], n)] {
        let degrees = both(units, n);
        for (i, factor) in [n, of_still, 1.0].into_iter().enumerate() {
            let [a, b] = [&degrees, &radians].map(|scales| scales[i].scale.expect("a size"));
            assert!((a - factor * b).abs() <= 1e-12 * a, "{a} {b}");
        }
    }
}
