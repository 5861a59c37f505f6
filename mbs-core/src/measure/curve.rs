//! Twice differentiable functions of a measured coordinate or length.
//!
//! ```text
//! spline      cubic through (x_i, f_i), natural, or periodic with x taken into its period
//! polynomial  c0 + c1 x + c2 x^2 + ...
//! ```

use crate::Real;
use crate::laws::guide;

/// Value f, f' and f'' of a cubic spline at `x`. If `period` is above zero, x is shifted into the period that begins at the first knot.
/// Otherwise the end values hold outside the knots.
///
/// Cost: one binary search; no allocation.
pub fn spline_curve<T: Real>(knots: &[[T; 2]], curvature: &[T], period: T, x: T) -> [T; 3] {
    let at = guide::spline(knots, curvature, within(knots, period, x));
    [at.value, at.rate, at.acceleration]
}

/// Shifts `x` into the period that begins at the first knot. Without a period above zero the result is `x`.
pub(crate) fn within<T: Real>(knots: &[[T; 2]], period: T, x: T) -> T {
    match knots {
        [first, .., last] if period > T::ZERO => {
            // rounding errors may put the result slightly outside the period
            taken_into(x, first[0], period).max(first[0]).min(last[0])
        }
        _ => x,
    }
}

/// Value f, f' and f'' at `x` of the polynomial with these coefficients, the constant one first.
pub fn polynomial<T: Real>(coefficients: &[T], x: T) -> [T; 3] {
    coefficients.iter().rev().fold([T::ZERO; 3], |[f, d, dd], &c| {
        // Horner's rule, with the derivatives by the product rule
        [f * x + c, d * x + f, dd * x + d + d]
    })
}

/// Difference f(x + dx) - f(x) of a polynomial by its divided difference, without cancellation of digits.
pub fn polynomial_change<T: Real>(coefficients: &[T], x: T, dx: T) -> T {
    let start = (T::ZERO, T::ZERO);
    let (_, quotient) = coefficients
        .iter()
        .rev()
        .fold(start, |(value, quotient), &c| (value * x + c, quotient * (x + dx) + value));
    quotient * dx
}

/// Difference f(x + dx) - f(x) of a [`spline_curve`], piece by piece from x to x + dx, without cancellation of digits.
///
/// Cost: one binary search for each piece between the two; no allocation.
pub fn spline_change<T: Real>((knots, curvature): (&[[T; 2]], &[T]), period: T, x: T, dx: T) -> T {
    let [first, .., last] = knots else { return T::ZERO };
    let (ends, is_periodic) = ([first[0], last[0]], period > T::ZERO);
    let (mut at, mut left, mut sum) = (x, dx, T::ZERO);
    if is_periodic {
        at = taken_into(x, ends[0], period);
    }
    // Each pass ends one piece of the curve. A step never covers more periods than the table has pieces.
    for _ in 0..=2 * knots.len() {
        let is_forward = left > T::ZERO;
        if left == T::ZERO {
            break;
        }
        if is_periodic && is_forward && at >= ends[1] {
            at -= period;
        } else if is_periodic && !is_forward && at <= ends[0] {
            at += period;
        }
        let above =
            knots.partition_point(|knot| if is_forward { knot[0] <= at } else { knot[0] < at });
        let Some(i) = above.checked_sub(1).filter(|&i| i + 1 < knots.len()) else {
            // Outside the knots the value is constant, up to the end knot in the direction of dx.
            let end = if is_forward { ends[0] } else { ends[1] };
            let gap = end - at;
            let is_towards = (gap > T::ZERO) == is_forward && gap != T::ZERO;
            if is_periodic || !is_towards || gap.abs() >= left.abs() {
                break;
            }
            (at, left) = (end, left - gap);
            continue;
        };
        let ([t0, g0], [t1, g1]) = (knots[i], knots[i + 1]);
        let bend = |i: usize| curvature.get(i).copied().unwrap_or(T::ZERO);
        let (c0, c1, h) = (bend(i), bend(i + 1), t1 - t0);
        let gap = if is_forward { t1 - at } else { t0 - at };
        let is_last = left.abs() <= gap.abs();
        let d = if is_last { left } else { gap };
        let s = at - t0;
        let sixth = T::ONE / T::from_f64(6.0);
        let three = T::from_f64(3.0);
        let slope = (g1 - g0) / h - h * (T::TWO * c0 + c1) * sixth;
        let (square, cube) = (c0 * T::HALF, (c1 - c0) * sixth / h);
        sum += d
            * (slope + square * (T::TWO * s + d) + cube * (three * s * s + three * s * d + d * d));
        if is_last {
            break;
        }
        (at, left) = (if is_forward { t1 } else { t0 }, left - d);
    }
    sum
}

/// Shifts x into the period that begins at `first`. Without `alloc` the function is not inlined, so that controllers store one copy.
#[cfg_attr(not(feature = "alloc"), inline(never))]
fn taken_into<T: Real>(x: T, first: T, period: T) -> T {
    let turns = libm::floor(((x - first) / period).to_f64());
    x - T::from_f64(turns) * period
}
