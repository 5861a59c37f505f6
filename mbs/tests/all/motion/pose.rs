//! Quaternions from axes, and the smallest rotation.

use mbs::inside::tested::{of_axes, smallest};

/// Rounding error of a few operations [-].
const ROUNDING: f64 = 1e-14;

#[test]
fn a_quaternion_of_axes_turns_the_axes_to_themselves() {
    for q in
        [[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, -0.5, 0.5], [0.1, 0.7, 0.1, 0.7], [0.0, 0.0, 0.6, 0.8]]
    {
        let size = q.iter().map(|x: &f64| x * x).sum::<f64>().sqrt();
        let [w, x, y, z] = q.map(|x| x / size);
        let columns = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
            [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
            [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
        ];
        let found = of_axes(columns);
        let same = (0..4).map(|i| found[i] * [w, x, y, z][i]).sum::<f64>().abs();
        assert!((same - 1.0).abs() < ROUNDING, "{found:?}");
    }
}

#[test]
fn the_smallest_turn_has_its_axis_across_both_directions_and_exists_for_half_a_turn() {
    let [w, x, y, z] = smallest([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let root = 0.5_f64.sqrt();
    assert!((w - root).abs() + x.abs() + y.abs() + (z - root).abs() < ROUNDING);
    let half = smallest([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]);
    assert!(half[0].abs() + half[1].abs() < ROUNDING);
}
