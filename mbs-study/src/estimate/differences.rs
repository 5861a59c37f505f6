//! Errors from the rows of a run alone: what its rule errs by in each step, added up. Said only where no comparison run ends.
//!
//! ```text
//! trapezoidal rule:   y(t + h) - y_h(t + h) = -h³ y'''/12 + ...,   y''' ~ 3! y[t₀, t₁, t₂, t₃]
//! error <= sum |h³ y'''| / 12
//! ```
//!
//! What the motion makes of errors on the way is not in it: a mechanism that damps has less, one that is sensitive has more.

/// Errors may grow on the way by this factor [-]. Over scenes with long steps, the sum is between 0.1 and 4 times below the error in nine
/// components of ten. Rates of natural coordinates may err by more, which rows do not show.
pub const GROWTH: f64 = 3.0;

/// Least error that a comparison run shows, in units of rounding of an output [-]. Chosen, not tuned.
pub(super) const ROUNDINGS: f64 = 8.0;

/// The error of each component of the rows (time, components), of which every step has one.
pub fn errors(rows: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let n = rows.first().map_or(0, |(_, row)| row.len());
    (0..n).map(|c| GROWTH * sum(rows, c).min(range(rows, c))).collect()
}

fn sum(rows: &[(f64, Vec<f64>)], c: usize) -> f64 {
    let third = |w: &[(f64, Vec<f64>)]| {
        let slope = |i: usize, j: usize, (a, b): (f64, f64)| (b - a) / (w[j].0 - w[i].0);
        let value = |i: usize| w[i].1[c];
        let first = [0, 1, 2].map(|i| slope(i, i + 1, (value(i), value(i + 1))));
        let second = [0, 1].map(|i| slope(i, i + 2, (first[i], first[i + 1])));
        let h = (w[3].0 - w[0].0) / 3.0;
        6.0 * slope(0, 3, (second[0], second[1])) * h.powi(3) / 12.0
    };
    rows.windows(4).map(|w| third(w).abs()).filter(|x| x.is_finite()).sum()
}

/// Largest less least value of a component.
pub(super) fn range(rows: &[(f64, Vec<f64>)], c: usize) -> f64 {
    let values = || rows.iter().map(|(_, row)| row[c]);
    values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
}
