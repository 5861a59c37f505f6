//! Angular velocity and acceleration of a rotation that follows a rotation vector, R = exp(f), in the axes that R leads from.
//!
//! ```text
//! ω  = f' + a f×f' + b f×(f×f')                                                     θ = |f|
//! ω' = f'' + a f×f'' + b (f×(f×f'') + f'×(f×f')) + f·f' (c f×f' + d f×(f×f'))
//! a = (1 − cos θ)/θ²,   b = (θ − sin θ)/θ³,   c = (sin θ/θ − 2 a)/θ²,   d = (a − 3 b)/θ²
//! ```
//!
//! All four are smooth at every angle; up to one radian, where they are small differences, their series are summed. Sources: the tangent
//! operator of the exponential map, Géradin and Cardona, *Flexible Multibody Dynamics* (2001).

use crate::Real;
use crate::algebra::{Vector, cross};

/// Square of the angle up to which series are summed [rad^2]: beyond one radian the closed forms lose two digits at most.
const SMALL: f64 = 1.0;

/// Terms of the series [-]: at one radian the next one is below a rounding of two doubles, 1/32! = 4e-36.
const TERMS: u32 = 15;

/// Angular velocity and acceleration [rad/s, rad/s^2] by a rotation vector and its first two derivatives.
pub fn spin<T: Real>([f, rate, second]: [Vector<T, 3>; 3]) -> [Vector<T, 3>; 2] {
    let [a, b, c, d] = factors(f.dot(&f));
    let across = cross(&f, &rate);
    let twice = cross(&f, &across);
    let across_second = cross(&f, &second);
    let omega = rate + across * a + twice * b;
    let along = f.dot(&rate);
    let omega_t = second
        + across_second * a
        + (cross(&f, &across_second) + cross(&rate, &across)) * b
        + across * (along * c)
        + twice * (along * d);
    [omega, omega_t]
}

/// a, b, c, d by the square of the angle.
fn factors<T: Real>(square: T) -> [T; 4] {
    if square > T::from_f64(SMALL) {
        let angle = square.sqrt();
        let (sine, cosine) = angle.sin_cos();
        let a = (T::ONE - cosine) / square;
        let b = (angle - sine) / (angle * square);
        let c = (sine / angle - T::TWO * a) / square;
        return [a, b, c, (a - T::from_f64(3.0) * b) / square];
    }
    // a = Σ (−s)ᵏ/(2k + 2)!,   b = Σ (−s)ᵏ/(2k + 3)!,   s = θ²;   c and d are twice their derivatives
    let (mut term, mut power) = ([T::HALF, T::HALF / T::from_f64(3.0)], T::ONE);
    let [mut a, mut b, mut c, mut d] = [term[0], term[1], T::ZERO, T::ZERO];
    for k in 1..=TERMS {
        let twice = T::from_f64(f64::from(2 * k));
        let [one, two, three] = [1.0, 2.0, 3.0].map(|i| twice + T::from_f64(i));
        term = [-term[0] / (one * two), -term[1] / (two * three)];
        c += term[0] * twice * power;
        d += term[1] * twice * power;
        power *= square;
        a += term[0] * power;
        b += term[1] * power;
    }
    [a, b, c, d]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::{Matrix, rotation};

    /// A rotation vector that turns about changing axes, up to three turns, with its derivatives.
    fn moving(t: f64) -> [Vector<f64, 3>; 3] {
        let w = [1.3, 0.7, -0.4];
        let at = |k: usize, n: u32| {
            let (s, c) = (w[k] * t + k as f64).sin_cos();
            let size = [2.0, -3.0, 11.0][k];
            size * [s, w[k] * c, -w[k] * w[k] * s][n as usize]
        };
        [0, 1, 2].map(|n| Vector::<f64, 3>::new(at(0, n), at(1, n), at(2, n)))
    }

    /// The axial vector of the skew part.
    fn axial(m: &Matrix<f64, 3>) -> Vector<f64, 3> {
        Vector::<f64, 3>::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)])
            * 0.5
    }

    #[test]
    fn the_angular_velocity_is_the_rate_of_the_rotation_through_several_turns() {
        // central differences of 1e-4: truncation 1e-8 times a third derivative of up to 1e3
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
        // the closed form of d loses two digits, and 1e-12 of the argument moves each by less
        for (x, y) in below.iter().zip(above) {
            assert!((x - y).abs() < 1.0e-12, "{x} {y}");
        }
        let none = [0.5, 1.0 / 6.0, -1.0 / 12.0, -1.0 / 60.0];
        for (x, y) in factors(0.0_f64).iter().zip(none) {
            assert!((x - y).abs() < 1.0e-16, "{x} {y}");
        }
    }
}
