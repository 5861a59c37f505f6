//! Principal moments and axes of an inertia.

use mbs::inside::tested::principal;

#[test]
fn a_turned_inertia_has_its_own_moments_along_its_own_axes() {
    // the inertia is diag(1, 2, 4), rotated about (1, 1, 1)/sqrt 3 by a third of a revolution, then about z by 0.3 rad
    let (sin, cos) = 0.3_f64.sin_cos();
    let axes = [[0.0, 0.0, 1.0], [cos, sin, 0.0], [-sin, cos, 0.0]];
    let of = |i: usize, j: usize| {
        (0..3).map(|k| [1.0, 2.0, 4.0][k] * axes[k][i] * axes[k][j]).sum::<f64>()
    };
    let matrix = [of(0, 0), of(1, 1), of(2, 2), of(0, 1), of(1, 2), of(2, 0)];
    let (moments, found) = principal(matrix);
    for (moment, axis) in moments.iter().zip(found) {
        let k = [1.0, 2.0, 4.0].iter().position(|x: &f64| (x - moment).abs() < 1e-12);
        let k = k.expect("a moment of the diagonal");
        let along: f64 = (0..3).map(|i| axes[k][i] * axis[i]).sum();
        assert!((along.abs() - 1.0).abs() < 1e-12, "{axis:?}");
    }
}
