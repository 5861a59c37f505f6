//! Monotone interpolation of tables: the function does not leave the range of two neighbouring rows. The function is the cubic spline where
//! the spline satisfies the bounds. Elsewhere slopes and curvatures at the rows are limited, and each interval gets two inner knots.
//!
//! ```text
//! on [x0, x1]:  h = x1 - x0,  D = (f1 - f0)/h,  knots x0 + h/4 and x1 - h/4;  slopes m, curvatures c of the two rows
//! f' is a quadratic spline with the coefficients of its B-splines
//! P0 = m0   P1 = m0 + c0 h/8   P2 = 3 D - e0 - e1   P3 = m1 - c1 h/8   P4 = m1,    e0 = (P0 + 3 P1)/4,  e1 = (3 P3 + P4)/4
//! ```
//!
//! P2 follows from the condition that f leads from f0 to f1. B-splines are not negative. If no coefficient has the sign opposite to D,
//! neither has f', and f stays between f0 and f1. Sufficient conditions are
//!
//! ```text
//! m D >= 0      |c| h/8 <= |m| if c moves the slope towards the sign opposite to m      e0 + e1 between 0 and 3 D
//! ```
//!
//! The first two conditions limit each row by itself. For the third, both rows of an interval are scaled by 3 D/(e0 + e1). The scaling
//! keeps the first two conditions, and a smaller factor keeps the third. Each row takes the smaller factor of its two intervals, so the
//! result does not depend on the order of the rows. Neighbouring intervals have m and c in common, so f is twice differentiable. Between
//! two rows with zero slope the largest third derivative is as small as possible.

use crate::Real;
use alloc::vec;
use alloc::vec::Vec;

/// Distance of an inner knot from its row, relative to the interval [-]. Between two rows with zero slope, the third derivative then has a
/// constant magnitude.
const INNER_KNOT: f64 = 0.25;
/// Distance of two rows below which no knots fit between them, in multiples of machine precision of x [-].
const MIN_DISTANCE: f64 = 64.0;

/// Curvatures and inner knots of a table that replace those of its spline.
struct Bounded {
    /// Curvature at each row; `None`: the spline's curvature.
    curvature: Vec<Option<f64>>,
    /// Inner knots (x, f, f'') between each row and the next; `None`: no inner knots are necessary.
    between: Vec<Option<[[f64; 3]; 2]>>,
}

/// Knots and curvatures of the monotone interpolation of a table, from the curvatures of its spline.
///
/// Cost: two passes over the rows.
pub(super) fn monotone<T: Real>(
    rows: &[[T; 2]],
    curvature: Vec<T>,
    is_periodic: bool,
) -> (Vec<[T; 2]>, Vec<T>) {
    let number = |(&[x, f], &c): (&[T; 2], &T)| [x, f, c].map(T::to_f64);
    let spline: Vec<[f64; 3]> = rows.iter().zip(&curvature).map(number).collect();
    let bounded = bounded(&spline, is_periodic, T::EPSILON.to_f64().max(f64::EPSILON));
    let (mut knots, mut bends) = (Vec::new(), Vec::new());
    for (i, row) in rows.iter().enumerate() {
        knots.push(*row);
        let of_spline = || curvature.get(i).copied().unwrap_or(T::ZERO);
        bends.push(bounded.curvature[i].map_or_else(of_spline, T::from_f64));
        for [x, f, c] in bounded.between.get(i).copied().flatten().into_iter().flatten() {
            knots.push([x, f].map(T::from_f64));
            bends.push(T::from_f64(c));
        }
    }
    (knots, bends)
}

/// Interval on one side of a row: its slope and its length.
#[derive(Clone, Copy)]
struct Side {
    slope: f64,
    h: f64,
    /// True if the neighbouring row is too close for inner knots.
    is_close: bool,
}

/// Limits the rows (x, f, f'') of a spline to the bounds.
fn bounded(spline: &[[f64; 3]], is_periodic: bool, rounding: f64) -> Bounded {
    let side = |pair: &[[f64; 3]]| {
        let ([x0, f0, _], [x1, f1, _]) = (pair[0], pair[1]);
        let h = x1 - x0;
        let is_close = h <= MIN_DISTANCE * rounding * x0.abs().max(x1.abs());
        Side { slope: (f1 - f0) / h, h, is_close }
    };
    let sides: Vec<Side> = spline.windows(2).map(side).collect();
    let n = sides.len();
    if n == 0 {
        return Bounded { curvature: vec![None; spline.len()], between: Vec::new() };
    }
    let beside = |i: usize| match i {
        0 => [is_periodic.then(|| sides[n - 1]), Some(sides[0])],
        i if i == n => [Some(sides[n - 1]), is_periodic.then(|| sides[0])],
        i => [Some(sides[i - 1]), Some(sides[i])],
    };
    let of_spline: Vec<[f64; 2]> = (0..=n).map(|i| tangent(spline, &sides, i)).collect();
    let of_rows: Vec<[f64; 2]> =
        of_spline.iter().enumerate().map(|(i, &of)| of_row(of, beside(i))).collect();
    // the factor 3 D/(e0 + e1) of each interval
    let factor = |(i, side): (usize, &Side)| {
        let ends = end_sum(of_rows[i], side.h, 1.0) + end_sum(of_rows[i + 1], side.h, -1.0);
        if ends.abs() > 3.0 * side.slope.abs() { 3.0 * side.slope / ends } else { 1.0 }
    };
    let factors: Vec<f64> = sides.iter().enumerate().map(factor).collect();
    let at_row = |i: usize| {
        let before = if i > 0 { Some(i - 1) } else { is_periodic.then(|| n - 1) };
        let after = if i < n { Some(i) } else { is_periodic.then_some(0) };
        let smallest = [before, after].into_iter().flatten().map(|k| factors[k]);
        let smallest = smallest.fold(1.0, f64::min);
        of_rows[i].map(|x| x * smallest)
    };
    let rows: Vec<[f64; 2]> = (0..=n).map(at_row).collect();
    #[allow(clippy::float_cmp, reason = "is it the spline itself?")]
    let is_kept = |i: usize| rows[i] == of_spline[i];
    let knots = |i: usize| {
        let needed = !(is_kept(i) && is_kept(i + 1) || sides[i].is_close);
        needed.then(|| inner([spline[i], spline[i + 1]], [rows[i], rows[i + 1]], sides[i]))
    };
    Bounded {
        curvature: (0..=n).map(|i| (!is_kept(i)).then_some(rows[i][1])).collect(),
        between: (0..n).map(knots).collect(),
    }
}

/// Slope and curvature of a spline at one of its knots.
fn tangent(spline: &[[f64; 3]], sides: &[Side], i: usize) -> [f64; 2] {
    let c = spline[i][2];
    let slope = match (sides.get(i), spline.get(i + 1)) {
        (Some(side), Some(next)) => side.slope - side.h * (2.0 * c + next[2]) / 6.0,
        _ => {
            let side = sides[i - 1];
            side.slope + side.h * (spline[i - 1][2] + 2.0 * c) / 6.0
        }
    };
    [slope, c]
}

/// Slope and curvature of a row, limited by the conditions of this row alone.
fn of_row([slope, c]: [f64; 2], [before, after]: [Option<Side>; 2]) -> [f64; 2] {
    let sides = || [before, after].into_iter().flatten();
    if sides().any(|side| side.is_close || side.slope == 0.0) {
        return [0.0; 2];
    }
    let m = if sides().all(|side| side.slope * slope > 0.0) { slope } else { 0.0 };
    let mut c = c;
    if let Some(side) = after {
        // the coefficient P1 gets the sign of D
        let least = -8.0 * m.abs() / side.h;
        c = side.slope.signum() * (side.slope.signum() * c).max(least);
    }
    if let Some(side) = before {
        // the coefficient P3 gets the sign of D
        let most = 8.0 * m.abs() / side.h;
        c = side.slope.signum() * (side.slope.signum() * c).min(most);
    }
    [m, c]
}

/// Sum e0 of the formulas above for the row at the left end of an interval, with `sign` 1. For the row at the right end, with `sign` -1, it
/// is e1.
fn end_sum([m, c]: [f64; 2], h: f64, sign: f64) -> f64 {
    m + sign * 3.0 * c * h / 32.0
}

/// Inner knots (x, f, f'') of an interval.
fn inner([a, b]: [[f64; 3]; 2], [first, last]: [[f64; 2]; 2], side: Side) -> [[f64; 3]; 2] {
    let ([m0, c0], [m1, c1], h) = (first, last, side.h);
    let (p1, p3) = (m0 + c0 * h / 8.0, m1 - c1 * h / 8.0);
    let p2 = 3.0 * side.slope - end_sum(first, h, 1.0) - end_sum(last, h, -1.0);
    // f'' at the knots: 2 (P2 - P1)/(3 h/4) and 2 (P3 - P2)/(3 h/4)
    let [ca, cb] = [p2 - p1, p3 - p2].map(|step| 8.0 * step / (3.0 * h));
    let way = INNER_KNOT * h;
    let sixth = way * way / 6.0;
    [
        [a[0] + way, a[1] + way * m0 + sixth * (2.0 * c0 + ca), ca],
        [b[0] - way, b[1] - way * m1 + sixth * (2.0 * c1 + cb), cb],
    ]
}
