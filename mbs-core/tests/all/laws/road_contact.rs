//! Contact point of a wheel on a road.

use mbs_core::laws::guide;
use mbs_core::laws::road::{self, Feature};
use mbs_core::laws::road_contact::*;
use mbs_core::laws::{LawInputs, Part};

/// Evenly spread numbers from 0 to 1, by the golden section.
fn spread(i: u32) -> f64 {
    (f64::from(i) * 0.618_033_988_749_894_9).fract()
}

fn rise(length: f64, height: f64, rounding: f64) -> Feature<f64> {
    Feature::Rise { start: 0.0, length, height, rounding }
}

fn bump(start: f64, length: f64, amplitude: f64) -> Feature<f64> {
    Feature::Bump { start, length, amplitude }
}

fn with<R>(features: &[Feature<f64>], f: impl FnOnce(Part, &LawInputs<'_, f64>) -> R) -> R {
    let n = u32::try_from(features.len()).expect("a short road");
    f(Part { first: 0, n }, &LawInputs { features, ..LawInputs::courses(&[]) })
}

/// Least distance among places spaced by 1e-4 of the height. It exceeds the true distance by 1e-8 of the height, times the
/// curvature.
fn by_search(road: Part, s: &LawInputs<'_, f64>, [x, z]: [f64; 2]) -> f64 {
    let reach = (z - road::height(road, s, x).value).abs();
    let places = (-10_000..=10_000).map(|i| x + f64::from(i) * 1e-4 * reach);
    let distance = |u: f64| {
        let above = z - road::height(road, s, u).value;
        ((u - x) * (u - x) + above * above).sqrt()
    };
    places.map(distance).fold(f64::INFINITY, f64::min)
}

/// Compares the distance found by the library with a search, for centres over the middle of a road.
fn holds(features: &[Feature<f64>], [from, to]: [f64; 2], heights: [f64; 2]) {
    with(features, |road, s| {
        for i in 0..400 {
            let x = from + (to - from) * spread(i);
            let above = heights[0] + (heights[1] - heights[0]) * spread(7 * i + 3);
            let z = road::height(road, s, x).value + above;
            let found = road_contact(road, s, [x, z]).distance.abs();
            let searched = by_search(road, s, [x, z]);
            let case = format!("{features:?} at ({x}, {z}): {found}, {searched}");
            assert!(found <= searched + 1e-13, "{case}");
            assert!(found >= searched - 2e-7 * searched, "{case}");
        }
    });
}

#[test]
fn the_foot_is_the_nearest_point_in_hollows_up_to_as_tight_as_the_wheel() {
    // Curvature times the wheel's radius of 0.36 m: 0.4, 0.65, 0.8, 0.97.
    for [length, height] in [[0.9, -0.25], [0.577, -0.15], [0.522, -0.15], [0.545, -0.2]] {
        for sign in [1.0, -1.0] {
            let road = [rise(length, sign * height, length / 2.0)];
            holds(&road, [-0.4, length + 0.4], [0.01, 0.36]);
        }
    }
    holds(&[bump(0.0, 2.0, -0.2)], [-0.4, 2.4], [0.01, 0.36]);
}

#[test]
fn the_foot_is_the_nearest_point_in_hollows_tighter_than_the_wheel_and_on_crests() {
    // Curvature times the distance up to 4: some centres have two almost equally near points.
    holds(&[rise(0.4, -0.2, 0.2)], [-0.4, 0.8], [0.01, 0.6]);
    holds(&[rise(0.3, 0.25, 0.1)], [-0.4, 0.8], [0.01, 0.6]);
    holds(&[bump(0.0, 1.0, 0.1), bump(1.0, 1.0, 0.1)], [0.0, 2.0], [0.01, 0.9]);
    holds(&[bump(0.0, 0.8, -0.15)], [-0.4, 1.2], [0.01, 0.9]);
    holds(&[rise(0.6, 0.3, 0.2), bump(0.3, 0.5, 0.05)], [-0.4, 1.0], [0.01, 0.7]);
}

#[test]
fn the_foot_is_the_nearest_point_far_above_a_road_and_a_little_below_it() {
    holds(&[rise(0.9, -0.25, 0.45)], [-1.0, 2.0], [0.4, 2.0]);
    holds(&[bump(0.0, 5.0, 0.1)], [-1.0, 6.0], [0.4, 2.0]);
    holds(&[bump(0.0, 5.0, 0.1)], [-1.0, 6.0], [-0.2, 0.0]);
}

#[test]
fn a_wheel_over_the_foot_of_a_stair_stands_where_it_touches() {
    // Newton's method without a bracket leaves this hollow: 0.3912 m.
    with(&[rise(0.577, -0.15, 0.2885)], |road, s| {
        let at = road_contact(road, s, [0.343_526_631, 0.290_336_3]);
        assert!((at.distance - 0.356).abs() < 1e-9, "{at:?}");
    });
}

#[test]
fn the_normal_is_the_gradient_of_the_distance_and_turns_as_computed() {
    let features = [
        Feature::Flat(0.1),
        Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 },
        bump(4.0, 3.0, 0.05),
    ];
    with(&features, |road, s| {
        let step = 1e-6;
        for i in 0..80 {
            let c = [0.1 * f64::from(i), 0.8];
            let near = |dx: f64, dz: f64| road_contact(road, s, [c[0] + dx, c[1] + dz]);
            let at = near(0.0, 0.0);
            let slope =
                |a: RoadContact<f64>, b: RoadContact<f64>| (a.distance - b.distance) / (2.0 * step);
            let by = [
                slope(near(step, 0.0), near(-step, 0.0)),
                slope(near(0.0, step), near(0.0, -step)),
            ];
            // The curvature jumps at corners, so that second-order differences err by the order of the step.
            assert!((by[0] - at.normal[0]).abs() < 1e-5 && (by[1] - at.normal[1]).abs() < 1e-5);
            // Derivative along the tangent (up, -x), away from corners.
            let along = |h: f64| near(at.normal[1] * h, -at.normal[0] * h);
            let (before, after) = (along(-step), along(step));
            if (before.bend - after.bend).abs() < 1e-4 {
                let turned = [0, 1].map(|k| (after.normal[k] - before.normal[k]) / (2.0 * step));
                let computed = [at.turn() * at.normal[1], -at.turn() * at.normal[0]];
                assert!(
                    (turned[0] - computed[0]).abs() < 1e-4
                        && (turned[1] - computed[1]).abs() < 1e-4,
                    "{c:?}: {turned:?} {computed:?}"
                );
            }
        }
    });
}

#[test]
fn on_a_straight_slope_the_distance_is_that_of_a_line() {
    with(
        &[
            Feature::Flat(0.1),
            Feature::Rise { start: 1.0, length: 2.0, height: 0.3, rounding: 0.5 },
        ],
        |road, s| {
            // The road has height 0.25 and slope 0.2 in the middle.
            let expected = (0.7 - 0.25) / 1.04_f64.sqrt();
            assert!((road_contact(road, s, [2.0, 0.7]).distance - expected).abs() < 1e-14);
        },
    );
}

#[test]
fn over_the_sharp_end_of_a_table_the_normal_points_to_the_centre() {
    let (knots, curvatures) = ([[0.0, 0.0], [1.0, 0.5]], [0.0, 0.0]);
    let features = [Feature::Spline(Part { first: 0, n: 2 })];
    let s =
        LawInputs { features: &features, knots: (&knots, &curvatures), ..LawInputs::courses(&[]) };
    let road = Part { first: 0, n: 1 };
    let at = road_contact(road, &s, [0.9, 0.9]);
    let d = (0.01_f64 + 0.16).sqrt();
    assert!((at.distance - d).abs() < 1e-12, "{at:?}");
    assert!((at.normal[0] + 0.1 / d).abs() < 1e-12 && (at.normal[1] - 0.4 / d).abs() < 1e-12);
    assert!((at.turn() - 1.0 / d).abs() < 1e-6 / d);
    // In the hollow at the other end the wheel touches both sides, and one of the two points is found.
    let at = road_contact(road, &s, [-0.05, 0.3]);
    let slope = (0.3 + 0.05 * 0.5) / 1.25_f64.sqrt();
    assert!((at.distance - slope).abs() < 1e-14, "{at:?} {slope}");
}

#[test]
fn the_foot_at_the_ends_of_a_table_is_the_nearest_point_from_both_sides() {
    let table = [[0.0, 0.0], [0.6, 0.05], [1.2, 0.02], [2.0, 0.1]];
    for (sx, sz) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let mut knots = table.map(|[x, z]| [8.0 + sx * x, sz * z]);
        if sx < 0.0 {
            knots.reverse();
        }
        let (mut curvatures, mut scratch) = ([0.0; 4], [0.0; 4]);
        guide::spline_curvatures(&knots, &mut curvatures, &mut scratch);
        let features = [Feature::Spline(Part { first: 0, n: 4 })];
        let s = LawInputs {
            features: &features,
            knots: (&knots, &curvatures),
            ..LawInputs::courses(&[])
        };
        let road = Part { first: 0, n: 1 };
        for i in 0..80 {
            let x = knots[3 * (i % 2)][0] - 0.06 + 0.0015 * i as f64;
            let center = [x, road::height(road, &s, x).value + 0.3];
            let (found, searched) =
                (road_contact(road, &s, center).distance, by_search(road, &s, center));
            assert!(found <= searched + 1e-13, "{knots:?} {center:?}: {found}, {searched}");
        }
    }
}

#[test]
fn what_is_not_a_number_ends_a_search() {
    with(&[bump(0.0, 5.0, 0.1)], |road, s| {
        for center in [[f64::NAN, 0.3], [1.0, f64::NAN], [1.0, f64::INFINITY], [f64::INFINITY, 0.3]]
        {
            let _ = road_contact(road, s, center);
        }
    });
}
