//! Order of a method: the slope of its error over the step, and the step at which rounding dominates.

use super::data::Fit;

/// Largest difference of the slopes between neighbouring points on one line [-]. Chosen, not tuned.
const SAME_SLOPE: f64 = 0.4;
/// Error from which the motion is not resolved and shows no order, relative to the outputs' ranges [-]. Chosen, not tuned.
const LOST: f64 = 0.2;
/// Smallest ratio of the longest to the shortest step of a line, which has at least three points [-]. Chosen, not tuned.
const SPAN: f64 = 4.0;
/// Largest root mean square of the deviations from a line, in decades of the error [-]. Chosen, not tuned.
const RESIDUAL: f64 = 0.15;
/// Largest order that a method can have [-].
const MOST_ORDER: f64 = 20.0;
/// Relative difference below which two steps are equal [-], since steps are adapted to the instants of the results. Chosen, not tuned.
const SAME_STEP: f64 = 1e-6;
/// Smallest ratio to the smallest error at which a larger error at a shorter step is attributed to rounding [-]. Chosen, not tuned.
const GROWN: f64 = 2.0;

/// Fits the order to points (step, error), from the longest step to the shortest. The reference does not resolve errors below `floor`.
pub fn fit(points: &[(f64, f64)], floor: f64) -> Option<Fit> {
    let least = points.iter().enumerate().min_by(|a, b| a.1.1.total_cmp(&b.1.1))?.0;
    let is_rounding = points[least..].iter().any(|&(_, e)| e > GROWN * points[least].1.max(floor));
    let rounding_below = is_rounding.then_some(points[least].0);
    // rounding changes the smallest error too, so it is left out
    let end = if is_rounding { least } else { points.len() };
    let mut resolved: Vec<(f64, f64)> =
        points[..end].iter().copied().filter(|&(_, e)| e > floor && e < LOST).collect();
    resolved.dedup_by(|next, last| (next.0 / last.0 - 1.0).abs() < SAME_STEP);
    let line = straight(&resolved);
    let is_line = is_line(line);
    Some(Fit {
        order: is_line.then(|| slope(line)),
        steps: is_line.then(|| [line[0].0, line[line.len() - 1].0]),
        points: if is_line { line.len() } else { 0 },
        rounding_below,
    })
}

/// True if neighbouring points lie on a line that shows an order.
fn is_line(points: &[(f64, f64)]) -> bool {
    let [first, _, .., last] = points else { return false };
    let order = slope(points);
    if !(first.0 / last.0 >= SPAN && order > 0.0 && order <= MOST_ORDER) {
        return false;
    }
    let n = points.len() as f64;
    let rest = |&(h, e): &(f64, f64)| libm::log10(e) - order * libm::log10(h);
    let mean = points.iter().map(rest).sum::<f64>() / n;
    let squares: f64 = points.iter().map(|p| (rest(p) - mean) * (rest(p) - mean)).sum();
    points.len() >= 3 && libm::sqrt(squares / n) <= RESIDUAL
}

/// Returns the longest sequence of neighbouring points with one slope. Among equally long ones, it is the one with the shortest steps.
fn straight(points: &[(f64, f64)]) -> &[(f64, f64)] {
    let mut best = &points[..0];
    for first in 0..points.len() {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for last in first + 1..points.len() {
            let s = slope(&points[last - 1..=last]);
            (low, high) = (low.min(s), high.max(s));
            // errors that grow with shorter steps are scatter
            if !(high - low <= SAME_SLOPE && low > 0.0) {
                break;
            }
            if last - first + 1 >= best.len() {
                best = &points[first..=last];
            }
        }
    }
    best
}

/// Slope of the straight line through the logarithms of step and error, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|&(h, e)| (libm::log(h), libm::log(e)));
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let (xy, xx) = logs()
        .fold((0.0, 0.0), |(xy, xx), (a, b)| (xy + (a - x) * (b - y), xx + (a - x) * (a - x)));
    xy / xx
}
