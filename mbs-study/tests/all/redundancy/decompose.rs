//! Groups of dependent joints from a null space.

use mbs_core::algebra::Vector;
use mbs_core::outputs::Wrench;
use mbs_linear::Matrix;
use mbs_study::inside::{Group, groups};
use mbs_study::redundancy::Jacobian;

#[test]
fn groups_of_a_null_space_do_not_depend_on_its_basis() {
    // each of five joints has two rows; one null vector is on joints 0 and 1, (1, 0, 1, 0, ...); another is on joints 2 and 3, (0, 0, 0, 0, 1,
    // -2, 0, 1)
    let zero = Wrench { force: Vector::zeros(), moment: Vector::zeros() };
    let rows = (0..5).map(|i| 2 * i..2 * i + 2).collect();
    let jacobian = Jacobian { matrix: Matrix::zeros(0, 0), rows, wrenches: vec![zero; 10] };
    let (a, b) = (0.5_f64.sqrt(), (1.0_f64 / 6.0).sqrt());
    let mut n = Matrix::zeros(10, 2);
    (n[(0, 0)], n[(2, 0)]) = (a, a);
    (n[(4, 1)], n[(5, 1)], n[(7, 1)]) = (b, -2.0 * b, b);
    let (c, s) = (0.6, 0.8);
    let turn = Matrix::from_fn(2, 2, |i, j| [[c, -s], [s, c]][i][j]);
    let expected = [vec![0, 1], vec![2, 3]].map(|places| Group { places, redundant: 1 });
    assert_eq!(groups(&jacobian, &n), expected);
    assert_eq!(groups(&jacobian, &n.times(&turn)), expected);
}
