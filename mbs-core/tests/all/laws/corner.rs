//! Kinks of a road: corners of its outline.

use mbs_core::laws::corner::{LawCorner, of_road};
use mbs_core::laws::guide::spline_curvatures;
use mbs_core::laws::road::{self, Feature};
use mbs_core::laws::road_contact::road_contact;
use mbs_core::laws::{LawInputs, Part};

fn kinks(features: &[Feature<f64>], knots: (&[[f64; 2]], &[f64])) -> Vec<LawCorner<f64>> {
    let law_inputs = LawInputs { features, knots, ..LawInputs::courses(&[]) };
    let n = u32::try_from(features.len()).expect("a short road");
    let mut all = Vec::new();
    of_road(Part { first: 0, n }, &law_inputs, |kink| all.push(kink));
    all
}

#[test]
fn features_have_kinks_at_their_ends_and_level_ones_have_none() {
    let rise = Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 };
    let bump = Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.05 };
    let all = kinks(&[Feature::Flat(0.1), rise, bump], (&[], &[]));
    let places: Vec<f64> = all.iter().map(|kink| kink.place).collect();
    assert_eq!(places, [1.0, 1.5, 2.5, 3.0, 4.0, 7.0]);
    // The slope of the ramp is 0.3 / 1.5, and its corner rises by 0.2 * 0.5 / 2.
    assert!((all[1].slope - 0.2).abs() < 1e-14 && (all[1].height - 0.15).abs() < 1e-15);
    assert!(all[4].slope.abs() < 1e-14 && (all[4].height - 0.4).abs() < 1e-15);
    let flat = Feature::Rise { start: 1.0, length: 2.0, height: 0.0, rounding: 0.5 };
    assert!(kinks(&[flat], (&[], &[])).is_empty());
}

#[test]
fn the_corner_at_an_end_of_a_table_has_two_kinks_on_a_crest_and_one_in_a_hollow() {
    let spline = [Feature::Spline(Part { first: 0, n: 2 })];
    let all = kinks(&spline, (&[[0.0, 0.0], [3.0, 4.0]], &[0.0, 0.0]));
    // Slope 4/3: half the angle has the tangent (1 - cos) / sin = (1 - 3/5) / (4/5) = 1/2.
    let expected = [(0.0, 0.0, 0.5), (3.0, 4.0, 4.0 / 3.0), (3.0, 4.0, 0.0)];
    assert_eq!(all.len(), 3);
    for (kink, (place, height, slope)) in all.iter().zip(expected) {
        let found = [kink.place - place, kink.height - height, kink.slope - slope];
        assert!(found.iter().all(|x| x.abs() < 1e-14), "{kink:?}");
    }
}

#[test]
fn a_kink_has_the_sign_of_the_foots_way_from_it() {
    let table = [[8.0, 0.0], [8.6, -0.05], [9.2, -0.08], [10.0, -0.1]];
    let (mut curvatures, mut scratch) = ([0.0; 4], [0.0; 4]);
    spline_curvatures(&table, &mut curvatures, &mut scratch);
    let features = [
        Feature::Rise { start: 1.0, length: 2.0, height: 0.6, rounding: 0.5 },
        Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.1 },
        Feature::Spline(Part { first: 0, n: 4 }),
    ];
    let law_inputs =
        LawInputs { features: &features, knots: (&table, &curvatures), ..LawInputs::courses(&[]) };
    let road = Part { first: 0, n: 3 };
    let all = kinks(&features, law_inputs.knots);
    // Six kinks with one slope, two of a crest where the table begins, one of a hollow where it ends.
    assert_eq!(all.len(), 9);
    let mut passed = 0;
    for i in 0..2200 {
        let x = 0.003 + 0.005 * f64::from(i);
        let center = [x, road::height(road, &law_inputs, x).value + 0.3];
        let at = road_contact(road, &law_inputs, center);
        let u = x - at.normal[0] * at.distance;
        for kink in &all {
            // On a crest the nearest point stays at the corner, up to rounding. In the hollow h''' shifts the jump.
            let g = kink.value(center);
            if (u - kink.place).abs() > 1e-9 && g.abs() > 1e-6 {
                assert_eq!(g > 0.0, u > kink.place, "{kink:?} from {center:?}");
                passed += usize::from(g > 0.0);
            }
        }
    }
    assert!(passed > 1000);
}
