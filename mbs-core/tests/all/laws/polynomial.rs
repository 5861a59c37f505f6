//! Piecewise polynomials: values, slopes, energies and kinks.

use mbs_core::laws::polynomial::*;

fn damper() -> [Piece<f64>; 3] {
    let piece = |range, c: &[f64]| Piece::new(range, c).expect("a piece");
    let mut pieces = [
        piece([-2.0, -0.2], &[-416.42, 1844.3]),
        piece([-0.2, 0.21], &[0.0, 9945.627, 33955.72, -59832.25, -395_651.0]),
        piece([0.21, 2.0], &[1919.1638, 1634.727]),
    ];
    link(&mut pieces);
    pieces
}

#[test]
fn kinks_are_where_value_or_slope_jump_and_not_where_pieces_join_smoothly() {
    let piece = |range, c: &[f64]| Piece::new(range, c).unwrap();
    // Three kinds of joints between pieces: none within a parabola, a bend, a step.
    let pieces = [
        piece([-1.0, 0.3], &[1.0, -2.0, 3.0]),
        piece([0.3, 2.0], &[1.0, -2.0, 3.0]),
        piece([2.0, 3.0], &[9.0]),
        piece([3.0, 4.0], &[8.0]),
    ];
    let mut found = Vec::new();
    kinks(&pieces, |place| found.push(place));
    assert_eq!(found, [2.0, 3.0]);
    // The pieces of the published damper join smoothly, within the digits of its coefficients.
    kinks(&damper(), |place| panic!("{place}"));
}

#[test]
fn re_centred_coefficients_give_the_same_polynomial() {
    let pieces = damper();
    let plain = |v: f64| {
        if v < -0.2 {
            -416.42 + 1844.3 * v
        } else if v < 0.21 {
            9945.627 * v + 33955.72 * v * v - 59832.25 * v.powi(3) - 395_651.0 * v.powi(4)
        } else {
            1919.1638 + 1634.727 * v
        }
    };
    for i in -300..300 {
        let v = f64::from(i) * 0.01 + 0.003;
        assert!((value(&pieces, v).0 - plain(v)).abs() < 1e-9, "{v}");
    }
}

#[test]
fn the_elastic_part_of_the_iltis_damper_keeps_its_digits() {
    let c = [-4.0092e6, 2.8397e7, -6.7061e7, 5.2796e7];
    let pieces = [Piece::<f64>::new([0.3, 0.6], &c).unwrap()];
    // The value at 0.44 m by rational arithmetic is exactly -155.136 N.
    assert!((value(&pieces, 0.44).0 + 155.136).abs() < 1e-8, "{}", value(&pieces, 0.44).0);
}

#[test]
fn slope_and_energy_belong_to_the_value() {
    let pieces = damper();
    let h = 1e-6;
    for x in [-2.5, -1.0, -0.19, 0.0, 0.15, 0.5, 2.5] {
        let by = (value(&pieces, x + h).0 - value(&pieces, x - h).0) / (2.0 * h);
        assert!((by - value(&pieces, x).1).abs() < 1e-3, "{x}");
        let by = (energy(&pieces, x + h) - energy(&pieces, x - h)) / (2.0 * h);
        assert!((by - value(&pieces, x).0).abs() < 1e-3, "{x}");
    }
}
