//! Complex linear systems, and quotients of matrices.

use mbs::Matrix;
use mbs::inside::tested::{Factor, divided, product, size};

/// Rounding error of a product of three rows [-].
const ROUNDING: f64 = 1e-14;

#[test]
fn a_complex_system_is_solved() {
    let a = [
        [0.0, 0.0],
        [1.0, 2.0],
        [0.5, -1.0],
        [3.0, 0.0],
        [0.0, 1.0],
        [2.0, 0.0],
        [1.0, 1.0],
        [0.0, 0.0],
        [0.0, -2.0],
    ];
    let x = [[1.0, -1.0], [2.0, 0.5], [0.0, 3.0]];
    let row = |i: usize| {
        (0..3).fold([0.0; 2], |sum: [f64; 2], j| {
            let [re, im] = product(a[3 * i + j], x[j]);
            [sum[0] + re, sum[1] + im]
        })
    };
    let found = Factor::new(3, a.to_vec()).solve(&[row(0), row(1), row(2)]);
    for (found, x) in found.iter().zip(x) {
        assert!(size([found[0] - x[0], found[1] - x[1]]) < ROUNDING, "{found:?}");
    }
}

#[test]
fn what_a_singular_matrix_divides_is_refused() {
    let matrix = |data: [f64; 4]| Matrix { rows: 2, columns: 2, data: data.to_vec() };
    let (r, s) = (matrix([1.0, 2.0, 3.0, 4.0]), matrix([1.0, 2.0, 2.0, 4.0]));
    assert_eq!(divided([&r, &r], &s), None);
    let Some([x, _]) = divided([&r, &r], &matrix([0.0, 2.0, 1e-9, 0.0])) else {
        panic!("columns count in their sizes");
    };
    for (found, right) in x.data.iter().zip([1.0, 1e9, 2.0, 3e9]) {
        assert!((found - right).abs() < ROUNDING * right, "{:?}", x.data);
    }
}
