//! Angular velocity of a rotation vector that depends on time.

use mbs_core::algebra::{Matrix, Vector, rotation};
use mbs_core::laws::spin::{factors, spin};

/// Rotation vector about changing axes, up to three turns, with its derivatives.
fn moving(t: f64) -> [Vector<f64, 3>; 3] {
    let w = [1.3, 0.7, -0.4];
    let at = |k: usize, n: u32| {
        let (s, c) = (w[k] * t + k as f64).sin_cos();
        let size = [2.0, -3.0, 11.0][k];
        size * [s, w[k] * c, -w[k] * w[k] * s][n as usize]
    };
    [0, 1, 2].map(|n| Vector::<f64, 3>::new(at(0, n), at(1, n), at(2, n)))
}

/// Axial vector of the skew-symmetric part of a matrix.
fn axial(m: &Matrix<f64, 3>) -> Vector<f64, 3> {
    Vector::<f64, 3>::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]) * 0.5
}

#[test]
fn the_angular_velocity_is_the_rate_of_the_rotation_through_several_turns() {
    // central differences of step 1e-4: truncation is 1e-8 times a third derivative of up to 1e3
    let h = 1.0e-4;
    for i in 0..100 {
        let t = -6.0 + 0.12 * f64::from(i);
        let [before, now, after] = [t - h, t, t + h].map(moving);
        let rate = (rotation(&after[0]) - rotation(&before[0])) * (0.5 / h);
        let [omega, omega_t] = spin(now);
        let found = axial(&(rate * rotation(&now[0]).transpose()));
        assert!((found - omega).norm() < 1.0e-5, "t = {t}: {found} {omega}");
        let second = (spin(after)[0] - spin(before)[0]) * (0.5 / h);
        assert!((second - omega_t).norm() < 2.0e-5, "t = {t}: {second} {omega_t}");
    }
}

#[test]
fn series_and_closed_forms_meet_at_one_radian_and_the_series_begin_as_in_the_books() {
    let [below, above] = [1.0_f64, 1.0 + 1.0e-12].map(factors);
    // the closed form of d loses two digits, and the difference 1e-12 of the argument changes each factor by less
    for (x, y) in below.iter().zip(above) {
        assert!((x - y).abs() < 1.0e-12, "{x} {y}");
    }
    let none = [0.5, 1.0 / 6.0, -1.0 / 12.0, -1.0 / 60.0];
    for (x, y) in factors(0.0_f64).iter().zip(none) {
        assert!((x - y).abs() < 1.0e-16, "{x} {y}");
    }
}
