//! Tables without overshoot between their rows: `interpolation = "monotone"`, by the rule of docs/EFFECTS.md.

use crate::scene::Spline;

/// The interval on one side of a row: its length, and the slope of its chord.
#[derive(Clone, Copy)]
struct Side {
    h: f64,
    rise: f64,
}

impl Spline {
    /// The monotone table of the rows of `spline`: its slopes and curvatures are limited to their bounds. With `repeats` the last row
    /// equals the first.
    #[must_use]
    pub fn monotone(spline: &Self, repeats: bool) -> Self {
        let rows = &spline.knots;
        let n = rows.len().saturating_sub(1);
        if n == 0 {
            return spline.clone();
        }
        let side = |i: usize| {
            let ([x0, f0, _], [x1, f1, _]) = (rows[i], rows[i + 1]);
            Side { h: x1 - x0, rise: (f1 - f0) / (x1 - x0) }
        };
        let left = |i: usize| if i > 0 { Some(i - 1) } else { repeats.then(|| n - 1) };
        let right = |i: usize| if i < n { Some(i) } else { repeats.then_some(0) };
        let of_spline = |i: usize| [spline.slope_at(i), rows[i][2]];
        let own: Vec<[f64; 2]> =
            (0..=n).map(|i| cut(of_spline(i), [left(i).map(side), right(i).map(side)])).collect();
        let share = |i: usize| {
            let sum = inner(own[i], side(i).h) + inner(mirrored(own[i + 1]), side(i).h);
            if sum.abs() > 3.0 * side(i).rise.abs() { 3.0 * side(i).rise / sum } else { 1.0 }
        };
        let ends: Vec<[f64; 2]> = (0..=n)
            .map(|i| {
                let sides = [left(i), right(i)].into_iter().flatten();
                let least = sides.map(share).fold(1.0, f64::min);
                own[i].map(|x| x * least)
            })
            .collect();
        let is_kept = |i: usize| (0..2).all(|k| ends[i][k].to_bits() == of_spline(i)[k].to_bits());
        let mut knots = Vec::new();
        for i in 0..=n {
            knots.push([rows[i][0], rows[i][1], ends[i][1]]);
            if i < n && !(is_kept(i) && is_kept(i + 1)) {
                knots.extend(between(rows[i], side(i), [ends[i], ends[i + 1]]));
            }
        }
        Self { knots }
    }
}

/// Slope and curvature of a row, limited to the bounds of the intervals on both sides.
fn cut([slope, curvature]: [f64; 2], [left, right]: [Option<Side>; 2]) -> [f64; 2] {
    let rises = || [left, right].into_iter().flatten().map(|side| side.rise);
    if rises().any(|rise| rise.abs() < f64::MIN_POSITIVE) {
        return [0.0; 2];
    }
    let m = if rises().all(|rise| rise * slope > 0.0) { slope } else { 0.0 };
    let mut c = curvature;
    // a coefficient whose sign differs from that of the chord becomes zero
    if let Some(side) = right
        && (m + c * side.h / 8.0) * side.rise < 0.0
    {
        c = -8.0 * m / side.h;
    }
    if let Some(side) = left
        && (m - c * side.h / 8.0) * side.rise < 0.0
    {
        c = 8.0 * m / side.h;
    }
    [m, c]
}

/// Returns slope and curvature as seen from the other end of the interval.
fn mirrored([slope, curvature]: [f64; 2]) -> [f64; 2] {
    [slope, -curvature]
}

/// The number e = m + 3 c h/32 of a row with the slope m and the curvature c, at the beginning of an interval of length h. The middle
/// coefficient of f' follows from it (docs/EFFECTS.md).
fn inner([slope, curvature]: [f64; 2], h: f64) -> f64 {
    slope + 3.0 * curvature * h / 32.0
}

/// The two knots within an interval of the function f. At a knot f'' is the difference of two coefficients of f', divided by their
/// distance. Between knots f'' is linear.
fn between([x, f, _]: [f64; 3], side: Side, [first, last]: [[f64; 2]; 2]) -> [[f64; 3]; 2] {
    let Side { h, rise } = side;
    let middle = 3.0 * rise - inner(first, h) - inner(mirrored(last), h);
    let before = first[0] + first[1] * h / 8.0;
    let after = last[0] - last[1] * h / 8.0;
    let [a, b] = [middle - before, after - middle].map(|step| step * 8.0 / (3.0 * h));
    let (short, long) = (h / 4.0, h / 2.0);
    let at_a = f + first[0] * short + (2.0 * first[1] + a) * short * short / 6.0;
    let slope = first[0] + (first[1] + a) * short / 2.0;
    let at_b = at_a + slope * long + (2.0 * a + b) * long * long / 6.0;
    [[x + short, at_a, a], [x + short + long, at_b, b]]
}
