//! Error estimate from the rows of a run alone: the sum of the local errors of its rule. It is used only if no comparison run is affordable
//! or completes. With step h, solution y and numerical solution y_h:
//!
//! ```text
//! trapezoidal rule:   y(t + h) - y_h(t + h) = -h³ y'''/12 + ...,   y''' ~ 3! y[t₀, t₁, t₂, t₃]
//! error <= sum |h³ y'''| / 12
//! ```
//!
//! The sum does not contain the growth or decay of earlier errors. A damped mechanism has smaller errors, a sensitive one larger errors.

/// Safety factor for the growth of errors during the run [-]. In nine of ten components of scenes with long steps, the error is 0.1 to 4 times
/// the sum. Rates of natural coordinates may have larger errors, which rows do not show.
pub const GROWTH: f64 = 3.0;

/// Smallest error that a comparison run shows, in units of the rounding of an output [-]. Chosen, not tuned.
pub(super) const ROUNDINGS: f64 = 8.0;

/// Estimates the error of each component. `rows` are (time, components), one row for each step.
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

/// Range of a component: its largest minus its smallest value.
pub(super) fn range(rows: &[(f64, Vec<f64>)], c: usize) -> f64 {
    let values = || rows.iter().map(|(_, row)| row[c]);
    values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
}
