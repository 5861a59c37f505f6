//! Coordinate sets of rows with few nonzero gradients, and the squares of such rows.

use mbs_core::inside::natural::{CoordinateSet, add_pair_square, add_squares};

#[test]
fn rows_of_one_or_two_entities_have_their_columns() {
    assert_eq!(CoordinateSet::of([3, 1, 3].into_iter(), 4, 3).pair(), Some([3, 9]));
    assert_eq!(CoordinateSet::of([2].into_iter(), 4, 3).pair(), Some([6, 6]));
    assert_eq!(CoordinateSet::of([0, 1, 2].into_iter(), 4, 3), CoordinateSet::ANY);
    assert_eq!(CoordinateSet::of([0, 1].into_iter(), 2, 3), CoordinateSet::ANY);
    assert_eq!(CoordinateSet::of([0, 90].into_iter(), 100, 3), CoordinateSet::ANY);
    assert_eq!(CoordinateSet::of([].into_iter(), 4, 3), CoordinateSet::ANY);
}

#[test]
fn square_of_a_short_row_is_that_of_the_whole_row() {
    let part = [0.3, -1.25, 2.0, 0.75, 4.0, -0.5];
    for [a, b] in [[0, 3], [3, 9], [0, 9], [6, 6]] {
        let mut g = [0.0; 12];
        g[b..b + 3].copy_from_slice(&part[3..]);
        g[a..a + 3].copy_from_slice(&part[..3]);
        let (mut short, mut whole) = ([0.5; 78], [0.5; 78]);
        add_pair_square::<f64, 3>(&mut short, 12, &g, [a, b], 1.5);
        add_squares(&mut whole, 12, [&g], [1.5]);
        assert_eq!(short.map(f64::to_bits), whole.map(f64::to_bits), "entities at {a} and {b}");
    }
}
