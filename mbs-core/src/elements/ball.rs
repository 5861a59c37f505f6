//! Angles of a ball joint, measured by directions of its bodies.
//!
//! ```text
//! a in the first body, b in the second; e1, e2 perpendicular to a, f1, f2 perpendicular to b; at angle zero a = b, e = f
//! swing   atan2(S, C)   C = a.b, S = |a x b|
//! twist   atan2(S, C)   C = e1.f1 + e2.f2, S = e2.f1 - e1.f2
//! grad    (C grad S - S grad C)/r^2,   r^2 = C^2 + S^2
//! bias    (C S_b - S C_b)/r^2 - 2 (C C' + S S')/r^2 rate
//! ```
//!
//! The twist is 2 atan2(v.a, w) of the relative quaternion (w, v), because S = 4 w v.a and C = 2 (w^2 - (v.a)^2). Its r is 1 + cos
//! of the swing, so that the twist is undefined at a swing of half a turn. At swing zero the swing has no direction, and its
//! gradient is set to zero.

use crate::Real;
use crate::algebra::{Vector, cross, lowered, norm, raised};

/// Direction in each of the two bodies.
type Pair<T, const D: usize> = [Vector<T, D>; 2];

/// Values C and S of a swing, and the direction about which the swing grows. At swing zero the direction is the zero vector.
fn swing_parts<T: Real, const D: usize>([a, b]: &Pair<T, D>) -> ([T; 2], Vector<T, 3>) {
    let across = cross(&raised(a), &raised(b));
    let s = norm(&across);
    let n = if s > T::ZERO { across * (T::ONE / s) } else { Vector::zeros() };
    ([a.dot(b), s], n)
}

/// Swing: the angle between two directions.
pub(crate) fn swing<T: Real, const D: usize>(pair: &Pair<T, D>) -> T {
    let ([c, s], _) = swing_parts(pair);
    s.atan2(c)
}

/// Gradient of the swing by both directions; zero if they are parallel.
pub(crate) fn swing_gradient<T: Real, const D: usize>(pair: &Pair<T, D>) -> Pair<T, D> {
    let ([c, s], n) = swing_parts(pair);
    if s == T::ZERO {
        return [Vector::zeros(); 2];
    }
    let inverse = T::ONE / (c * c + s * s);
    let (c, s) = (c * inverse, s * inverse);
    let [a, b] = pair;
    // derivative: dS = n.(da x b + a x db)
    let by = |m: Vector<T, 3>, other: &Vector<T, D>| lowered::<T, D>(&m) * c - other * s;
    [by(cross(&raised(b), &n), b), by(cross(&n, &raised(a)), a)]
}

/// Rate of the swing, and the part of its second derivative without accelerations.
pub(crate) fn swing_rates<T: Real, const D: usize>(
    pair: &Pair<T, D>,
    [a_t, b_t]: &Pair<T, D>,
) -> [T; 2] {
    let ([c, s], n) = swing_parts(pair);
    if s == T::ZERO {
        return [T::ZERO; 2];
    }
    let [a, b] = pair;
    let moving = cross(&raised(a_t), &raised(b)) + cross(&raised(a), &raised(b_t));
    let (c_t, s_t) = (a_t.dot(b) + a.dot(b_t), n.dot(&moving));
    let turning = cross(&raised(a_t), &raised(b_t)) * T::TWO;
    let s_b = n.dot(&turning) + (moving.dot(&moving) - s_t * s_t) / s;
    rates([c, s], [c_t, s_t], [T::TWO * a_t.dot(b_t), s_b])
}

/// Values C and S of a twist. They are linear in each pair of directions. If the rates of a pair replace the pair, the result is
/// the part of the rates C' and S' that this pair causes.
pub(crate) fn twist_parts<T: Real, const D: usize>(
    [e1, e2]: &Pair<T, D>,
    [f1, f2]: &Pair<T, D>,
) -> [T; 2] {
    [e1.dot(f1) + e2.dot(f2), e2.dot(f1) - e1.dot(f2)]
}

/// Gradient of the twist by the directions e1, e2 and f1, f2.
pub(crate) fn twist_gradient<T: Real, const D: usize>(
    first: &Pair<T, D>,
    second: &Pair<T, D>,
) -> [Pair<T, D>; 2] {
    let [c, s] = twist_parts(first, second);
    let inverse = T::ONE / (c * c + s * s);
    let (c, s) = (c * inverse, s * inverse);
    let ([e1, e2], [f1, f2]) = (first, second);
    [[-(f2 * c + f1 * s), f1 * c - f2 * s], [e2 * c - e1 * s, -(e1 * c + e2 * s)]]
}

/// Directions g for which the rate of each angle is g.(omega2 - omega1). `a` and `b` are unit vectors. The first is zero at swing
/// zero.
///
/// ```text
/// swing   (a x b)/|a x b|
/// twist   (a + b)/(1 + a.b)
/// ```
#[must_use]
pub fn ball_directions<T: Real>(a: &Vector<T, 3>, b: &Vector<T, 3>) -> [Vector<T, 3>; 2] {
    let (_, n) = swing_parts(&[*a, *b]);
    [n, (a + b) * (T::ONE / (T::ONE + a.dot(b)))]
}

/// Rate of the twist, and the part of its second derivative without accelerations.
pub(crate) fn twist_rates<T: Real, const D: usize>(
    (first, second): (&Pair<T, D>, &Pair<T, D>),
    (first_t, second_t): (&Pair<T, D>, &Pair<T, D>),
) -> [T; 2] {
    let [by_first, by_second] = [twist_parts(first_t, second), twist_parts(first, second_t)];
    let moving = [by_first[0] + by_second[0], by_first[1] + by_second[1]];
    let bias = twist_parts(first_t, second_t).map(|x| T::TWO * x);
    rates(twist_parts(first, second), moving, bias)
}

/// Rate and bias of atan2(S, C), from C and S, their rates and their biases.
fn rates<T: Real>([c, s]: [T; 2], [c_t, s_t]: [T; 2], [c_b, s_b]: [T; 2]) -> [T; 2] {
    let inverse = T::ONE / (c * c + s * s);
    let turn = (c * s_t - s * c_t) * inverse;
    [turn, ((c * s_b - s * c_b) - T::TWO * (c * c_t + s * s_t) * turn) * inverse]
}
