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
#[doc(hidden)]
pub fn factors<T: Real>(square: T) -> [T; 4] {
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
