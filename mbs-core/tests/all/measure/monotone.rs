//! Monotone tables, which stay between neighbouring rows: values, derivatives and ranges.

use mbs_core::measure::PreparedCurve;
use mbs_core::scene::{Curve, CurveShape, Interpolation, TableEnds};
use mbs_testkit::random::Random;

/// Number of parts of an interval at whose ends a table is evaluated.
const PARTS: usize = 64;

fn monotone(rows: &[[f64; 2]], periodic: bool) -> PreparedCurve<f64> {
    let shape = CurveShape::Monotone;
    PreparedCurve::new(Some(&Curve::Shaped { rows: rows.to_vec(), shape, periodic }))
}

/// Places in the interval between two rows, with both ends.
fn places(pair: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    let [x0, x1] = [pair[0][0], pair[1][0]];
    (0..=PARTS).map(move |k| x0 + (x1 - x0) * k as f64 / PARTS as f64)
}

/// Largest excess of a table over the values of the two neighbouring rows, relative to the table's largest value.
fn excess(curve: &PreparedCurve<f64>, rows: &[[f64; 2]]) -> f64 {
    let size = rows.iter().fold(0.0_f64, |most, row| most.max(row[1].abs()));
    let of = |pair: &[[f64; 2]]| {
        let (low, high) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
        let values = places(pair).map(|x| curve.at(x)[0]);
        values.map(|f| (low - f).max(f - high)).fold(0.0, f64::max)
    };
    rows.windows(2).map(of).fold(0.0, f64::max) / size
}

fn assert_near(found: [f64; 3], expected: [f64; 3]) {
    let is_near = found.iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-14);
    assert!(is_near, "{found:?} {expected:?}");
}

/// Cam with two dwells, in degrees and millimetres.
const CAM: [[f64; 2]; 7] = [
    [0.0, 0.0],
    [60.0, 0.0],
    [120.0, 10.0],
    [180.0, 10.0],
    [240.0, 0.0],
    [300.0, 0.0],
    [360.0, 0.0],
];
/// Characteristic of a buffer: travel [mm], force [kN].
const BUFFER: [[f64; 2]; 5] = [[0.0, 100.0], [2.0, 80.0], [7.0, 20.0], [12.0, 0.0], [120.0, 0.0]];

/// Smallest and largest value of a table within its rows.
fn range(curve: &PreparedCurve<f64>, rows: &[[f64; 2]]) -> [f64; 2] {
    let values = || rows.windows(2).flat_map(places).map(|x| curve.at(x)[0]);
    [values().fold(f64::MAX, f64::min), values().fold(f64::MIN, f64::max)]
}

#[test]
fn a_cam_with_dwells_stays_within_its_lift_and_its_spline_does_not() {
    let once = CAM[..6].to_vec();
    let [low, high] = range(&PreparedCurve::new(Some(&Curve::Periodic(once.clone()))), &once);
    assert!(low < -0.8 && high > 12.0, "{low} {high}");
    for (rows, periodic) in [(&CAM[..6], false), (&CAM[..6], true), (&CAM[..], true)] {
        let [low, high] = range(&monotone(rows, periodic), rows);
        assert!(low >= 0.0 && high <= 10.0 + 4.0 * f64::EPSILON * 10.0, "{low} {high}");
    }
}

#[test]
fn a_buffer_never_pulls() {
    let curve = monotone(&BUFFER, false);
    let spline = PreparedCurve::new(Some(&Curve::Table(BUFFER.to_vec())));
    let least = |curve: &PreparedCurve<f64>| range(curve, &BUFFER)[0];
    assert!((-33.0..-31.0).contains(&least(&spline)), "{}", least(&spline));
    assert!(least(&curve) >= 0.0);
    for x in [-5.0, 120.0, 500.0] {
        assert_near(curve.at(x), if x < 0.0 { [100.0, 0.0, 0.0] } else { [0.0; 3] });
    }
}

/// A rise from rest to rest has a rate of three parabolas: the largest f'' is 8 D/h at a quarter, and |f'''| is 32 D/h^2
/// everywhere.
#[test]
fn a_rise_from_rest_to_rest_has_its_closed_form() {
    let rows = [[0.0, 1.0], [1.0, 1.0], [3.0, 4.0], [4.0, 4.0]];
    let curve = monotone(&rows, false);
    let (height, h) = (3.0, 2.0);
    for (s, f, rate, bend) in [
        (0.0, 0.0, 0.0, 0.0),
        (0.25, 1.0 / 12.0, 1.0, 8.0),
        (0.5, 0.5, 2.0, 0.0),
        (0.75, 11.0 / 12.0, 1.0, -8.0),
        (1.0, 1.0, 0.0, 0.0),
    ] {
        let expected = [1.0 + height * f, height * rate / h, height * bend / (h * h)];
        let found = curve.at(1.0 + h * s);
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-14 * 10.0, "{s}: {found:?} {expected:?}");
        }
    }
}

#[test]
fn a_table_whose_spline_stays_between_its_rows_has_the_bits_of_the_spline() {
    let rows: Vec<[f64; 2]> =
        (0..9).map(|i| f64::from(i) * 0.3).map(|x| [x, x + 0.2 * x * x]).collect();
    let spline = PreparedCurve::new(Some(&Curve::Table(rows.clone())));
    assert_eq!(monotone(&rows, false), spline);
    let two = [[0.0, 1.0], [2.0, -3.0]];
    assert_eq!(monotone(&two, false), PreparedCurve::new(Some(&Curve::Table(two.to_vec()))));
    for few in [&two[..0], &two[..1]] {
        assert_eq!(monotone(few, false), PreparedCurve::new(Some(&Curve::Table(few.to_vec()))));
    }
}

/// Rows at random distances, with rises, falls, dwells, and values that differ by powers of ten.
fn random_rows(random: &mut Random, n: usize, is_periodic: bool) -> Vec<[f64; 2]> {
    let (mut x, mut f) = (random.next(), 0.0);
    let mut rows = Vec::new();
    for _ in 0..n {
        rows.push([x, f]);
        x += 10.0_f64.powf(random.next());
        if random.next() > -0.4 {
            f += random.next() * 10.0_f64.powf(1.5 * random.next());
        }
    }
    if is_periodic {
        rows.push([x, rows[0][1]]);
    }
    rows
}

#[test]
fn random_tables_stay_between_their_rows_and_are_twice_differentiable() {
    let mut random = Random::new(11);
    for case in 0..2000 {
        let (n, is_periodic) = (3 + case % 7, case % 3 == 0);
        let rows = random_rows(&mut random, n, is_periodic);
        let ends = if case % 2 == 0 { TableEnds::Natural } else { TableEnds::Level };
        let curve = PreparedCurve::table(&rows, Interpolation::Monotone(ends), is_periodic);
        let size = rows.iter().fold(0.0_f64, |most, row| most.max(row[1].abs()));
        if size > 0.0 {
            assert!(excess(&curve, &rows) < 8.0 * f64::EPSILON, "{case}: {rows:?}");
        }
        assert!(rows.iter().all(|row| (curve.at(row[0])[0] - row[1]).abs() <= 1e-12 * size));
        let PreparedCurve::Spline { knots, curvature, .. } = &curve else { panic!("a table") };
        // both pieces beside a knot agree there, within rounding
        for i in 1..knots.len() - 1 {
            let (x, near) = (knots[i][0], 1e-9);
            let gaps = [x - knots[i - 1][0], knots[i + 1][0] - x];
            let [left, right] = [x - near * gaps[0], x + near * gaps[1]].map(|x| curve.at(x));
            let pieces = [i - 1, i].map(|k| {
                let h = knots[k + 1][0] - knots[k][0];
                let bend = curvature[k].abs() + curvature[k + 1].abs();
                (knots[k + 1][1] - knots[k][1]).abs() / h + bend * h + 1e-6 * size / h
            });
            let slope = pieces[0].max(pieces[1]);
            assert!((left[1] - right[1]).abs() <= 1e-7 * slope, "{case}: {left:?} {right:?}");
            let bend = slope / gaps[0].min(gaps[1]);
            assert!((left[2] - right[2]).abs() <= 1e-7 * bend, "{case}: {left:?} {right:?}");
        }
        if let (true, [first, .., last]) = (is_periodic, &rows[..]) {
            let [begin, end] = [first[0], last[0] * (1.0 - 1e-16)].map(|x| curve.at(x));
            let scale = begin[1].abs() + size / (last[0] - first[0]);
            assert!((begin[1] - end[1]).abs() <= 1e-9 * scale, "{case}: {begin:?} {end:?}");
        }
    }
}

#[test]
fn derivatives_are_those_of_the_values() {
    let curve = monotone(&[[0.0, 0.0], [1.0, 0.1], [1.5, 2.0], [4.0, 2.1], [5.0, 0.0]], false);
    for k in 1..100 {
        let (x, e) = (0.0497 * f64::from(k), 1e-5);
        let [before, here, after] = [x - e, x, x + e].map(|x| curve.at(x));
        assert!(((after[0] - before[0]) / (2.0 * e) - here[1]).abs() < 1e-8, "{x}");
        assert!(((after[1] - before[1]) / (2.0 * e) - here[2]).abs() < 2e-3, "{x}");
        assert!((curve.change(x, 0.7) - (curve.at(x + 0.7)[0] - here[0])).abs() < 1e-14, "{x}");
    }
}

#[test]
fn a_mirrored_table_is_the_mirrored_function() {
    let rows = [[0.0, 0.0], [1.0, 0.1], [1.5, 2.0], [4.0, 2.1], [5.0, 0.0]];
    let mirrored: Vec<[f64; 2]> = rows.iter().rev().map(|[x, f]| [5.0 - x, -f]).collect();
    let [one, other] = [monotone(&rows, false), monotone(&mirrored, false)];
    for k in 0..=100 {
        let x = 0.05 * f64::from(k);
        let ([a, da, _], [b, db, _]) = (one.at(x), other.at(5.0 - x));
        assert!((a + b).abs() < 1e-14 && (da - db).abs() < 1e-13, "{x}");
    }
}

/// Samples of a smooth increasing function: the error falls with the fourth power of the distance of the rows.
#[test]
fn a_smooth_rise_is_met_with_the_fourth_power_of_the_distance() {
    let error = |n: u32| {
        let rows: Vec<[f64; 2]> =
            (0..=n).map(|i| f64::from(i) / f64::from(n)).map(|x| [x, (2.0 * x).exp()]).collect();
        let curve = monotone(&rows, false);
        // far from the ends, where the natural spline has order two only
        let at = (0..=200).map(|k| 0.3 + 0.002 * f64::from(k));
        at.map(|x| (curve.at(x)[0] - (2.0 * x).exp()).abs()).fold(0.0, f64::max)
    };
    let ratio = error(40) / error(80);
    assert!((15.0..17.0).contains(&ratio), "{ratio}");
}

#[test]
fn rows_nearer_than_rounding_are_joined_by_a_straight_line() {
    let x = 1.0 + 4.0 * f64::EPSILON;
    let rows = [[0.0, 0.0], [1.0, 1.0], [x, 5.0], [2.0, 5.5]];
    let curve = monotone(&rows, false);
    assert!(excess(&curve, &rows) < 8.0 * f64::EPSILON);
    let narrow: Vec<[f32; 2]> = rows.iter().map(|row| row.map(|x| x as f32)).collect();
    let near = [narrow[0], narrow[1], [1.0 + 4.0 * f32::EPSILON, 5.0], narrow[3]];
    let curve = PreparedCurve::table(&near, Interpolation::Monotone(TableEnds::Natural), false);
    for k in 0..=200 {
        let [f, ..] = curve.at(0.01 * k as f32);
        assert!((0.0..=5.5001).contains(&f), "{k}: {f}");
    }
}

#[test]
fn a_linear_table_is_straight_and_repeats() {
    let shape = CurveShape::Linear;
    let rows = vec![[0.0_f64, 0.0], [1.0, 2.0], [3.0, 0.0]];
    let curve = PreparedCurve::new(Some(&Curve::Shaped { rows, shape, periodic: true }));
    assert_near(curve.at(0.5), [1.0, 2.0, 0.0]);
    assert_near(curve.at(5.0), [1.0, -1.0, 0.0]);
    assert!((curve.change(0.5, 3.0) - (curve.at(3.5)[0] - 1.0)).abs() < 1e-15);
}
