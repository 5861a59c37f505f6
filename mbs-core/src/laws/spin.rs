//! Angular velocity ω and acceleration ω' of a rotation R = exp(f) with the rotation vector f(t), in the axes of the reference
//! frame.
//!
//! ```text
//! ω  = f' + a f×f' + b f×(f×f')                                                     θ = |f|
//! ω' = f'' + a f×f'' + b (f×(f×f'') + f'×(f×f')) + f·f' (c f×f' + d f×(f×f'))
//! a = (1 − cos θ)/θ²,   b = (θ − sin θ)/θ³,   c = (sin θ/θ − 2 a)/θ²,   d = (a − 3 b)/θ²
//! ```
//!
//! The factors a, b, c and d are smooth at every angle. Up to one radian the closed forms subtract nearly equal numbers, and series
//! are used. Source: the tangent operator of the exponential map, Géradin and Cardona, *Flexible Multibody Dynamics* (2001).

use crate::Real;
use crate::algebra::{Vector, cross};

/// Square of the largest angle for which series are used [rad^2]: beyond one radian the closed forms lose at most two digits.
const SMALL: f64 = 1.0;

/// Number of terms of the series [-]: at one radian the next term, 1/32! = 4e-36, is below the rounding of a pair of doubles.
const TERMS: u32 = 15;

/// Angular velocity and acceleration [rad/s, rad/s^2] of a rotation vector with its first two derivatives.
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

/// Factors a, b, c, d as functions of the squared angle.
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
    // a = Σ (−s)ᵏ/(2k + 2)!,   b = Σ (−s)ᵏ/(2k + 3)!,   s = θ²;   c and d are twice their derivatives by s
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
