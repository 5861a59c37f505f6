//! Height and slope of a road.

use mbs_core::inside::spline_hollow;
use mbs_core::laws::guide;
use mbs_core::laws::road::*;
use mbs_core::laws::{LawInputs, Part};

const ROAD: [Feature<f64>; 3] = [
    Feature::Flat(0.1),
    Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 },
    Feature::Bump { start: 4.0, length: 3.0, amplitude: 0.05 },
];

fn law_inputs() -> (Part, LawInputs<'static, f64>) {
    let law_inputs = LawInputs { features: &ROAD, ..LawInputs::courses(&[]) };
    (Part { first: 0, n: 3 }, law_inputs)
}

#[test]
fn slope_and_curvature_are_derivatives_of_the_height() {
    let (road, s) = law_inputs();
    let step = 1e-6;
    for i in 0..90 {
        let x = 0.013 + 0.1 * f64::from(i);
        let (a, h, b) =
            (height(road, &s, x - step), height(road, &s, x), height(road, &s, x + step));
        assert!(((b.value - a.value) / (2.0 * step) - h.slope).abs() < 1e-8, "{x}");
        assert!(((b.slope - a.slope) / (2.0 * step) - h.curvature).abs() < 1e-6, "{x}");
    }
    assert!((height(road, &s, 0.0).value - 0.1).abs() < 1e-15);
    assert!((height(road, &s, 3.5).value - 0.4).abs() < 1e-15);
    assert!((height(road, &s, 5.5).value - 0.5).abs() < 1e-15);
}

#[test]
fn the_bound_of_a_hollow_holds_where_a_road_bends_and_level_parts_have_none() {
    let (road, s) = law_inputs();
    for i in 0..90 {
        let x = 0.013 + 0.1 * f64::from(i);
        match hollow(road, &s, [x - 0.02, x + 0.02]) {
            Some(bound) => assert!(height(road, &s, x).curvature <= bound, "{x}"),
            None => assert!(height(road, &s, x).slope == 0.0, "{x}"),
        }
    }
    assert_eq!(hollow(road, &s, [0.0, 0.9]), None);
    assert_eq!(hollow(road, &s, [3.1, 3.9]), None);
}

#[test]
fn a_table_is_as_hollow_as_its_knots_and_has_no_bound_where_it_rises_from_its_end() {
    let table = [[0.0, 0.0], [1.0, 0.1], [2.0, 0.0], [3.0, 0.1], [4.0, 0.0]];
    let (mut curvatures, mut scratch) = ([0.0; 5], [0.0; 5]);
    guide::spline_curvatures(&table, &mut curvatures, &mut scratch);
    let of = |x| spline_hollow(&table, &curvatures, x);
    assert_eq!(of([-2.0, -0.1]), None);
    assert_eq!(of([4.1, 9.0]), None);
    assert_eq!(of([1.2, 1.8]), Some(curvatures[2]));
    assert_eq!(of([1.2, 2.8]), Some(curvatures[2]));
    assert!(of([-0.1, 0.1]) > Some(1e9) && of([3.9, 4.2]) > Some(1e9));
}
