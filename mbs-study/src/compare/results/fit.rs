//! The order of a method: the slope of its error against the step, and where rounding takes over.

use super::data::Fit;

/// Largest difference of slopes between neighbours that belong to one line [-]. Chosen, not tuned.
const SAME_SLOPE: f64 = 0.4;
/// Error from which a motion is lost and shows no order, relative to the outputs' ranges [-]. Chosen, not tuned.
const LOST: f64 = 0.2;
/// Least ratio of the longest to the shortest step of a line [-], of which it has three or more. Chosen, not tuned.
const SPAN: f64 = 4.0;
/// Largest root of the mean square of a line's misfits [decades]. Chosen, not tuned.
const RESIDUAL: f64 = 0.15;
/// Largest order that a method can have [-].
const MOST_ORDER: f64 = 20.0;
/// Relative difference below which steps are the same [-]: they end at the instants of the results. Chosen, not tuned.
const SAME_STEP: f64 = 1e-6;
/// Ratio of an error at shorter steps to the least one, from which it is rounding [-]. Chosen, not tuned.
const GROWN: f64 = 2.0;

/// Fits the order to points (step, error), from the longest step to the shortest. Errors below `floor` are what the reference
/// cannot resolve.
pub(super) fn fit(points: &[(f64, f64)], floor: f64) -> Option<Fit> {
    let least = points.iter().enumerate().min_by(|a, b| a.1.1.total_cmp(&b.1.1))?.0;
    let is_rounding = points[least..].iter().any(|&(_, e)| e > GROWN * points[least].1.max(floor));
    let rounding_below = is_rounding.then_some(points[least].0);
    // the least error itself is bent by what makes the others grow
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

/// Does a stretch show an order?
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

/// The longest stretch of neighbours with one slope; of equally long ones that at the shortest steps.
fn straight(points: &[(f64, f64)]) -> &[(f64, f64)] {
    let mut best = &points[..0];
    for first in 0..points.len() {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for last in first + 1..points.len() {
            let s = slope(&points[last - 1..=last]);
            (low, high) = (low.min(s), high.max(s));
            // a line that falls the wrong way is scatter
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

/// Slope of the straight line through the logarithms, by least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|&(h, e)| (libm::log(h), libm::log(e)));
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / n, y + b / n));
    let (xy, xx) = logs()
        .fold((0.0, 0.0), |(xy, xx), (a, b)| (xy + (a - x) * (b - y), xx + (a - x) * (a - x)));
    xy / xx
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps() -> impl Iterator<Item = f64> {
        (0..9).map(|k| 0.01 * f64::powi(0.5, k))
    }

    #[test]
    fn a_power_law_has_its_power_and_all_points_are_used() {
        let points: Vec<_> = steps().map(|h| (h, 3.0 * h * h)).collect();
        let fit = fit(&points, 0.0).unwrap();
        assert!((fit.order.unwrap() - 2.0).abs() < 1e-12);
        assert_eq!((fit.points, fit.rounding_below), (9, None));
    }

    #[test]
    fn rounding_is_found_where_errors_grow_again_and_does_not_bend_the_order() {
        let points: Vec<_> = steps().map(|h| (h, 3.0 * h * h + 1e-12 / (h * h))).collect();
        let fit = fit(&points, 0.0).unwrap();
        // at the shortest step on the line, 1.25e-3 s, rounding is an eighth of the error: it bends the last slope by a tenth
        assert!((fit.order.unwrap() - 2.0).abs() < 0.1, "{fit:?}");
        // 3 h^4 = 1e-12 at h = 7.6e-4
        let below = fit.rounding_below.unwrap();
        assert!((6e-4..9e-4).contains(&below), "{below}");
    }

    #[test]
    fn errors_that_have_lost_the_motion_or_that_the_reference_cannot_resolve_are_left_out() {
        let error = |h: f64| (3e4 * h * h).clamp(1e-4, 0.7);
        let points: Vec<_> = steps().map(|h| (h, error(h))).collect();
        let fit = fit(&points, 3e-4).unwrap();
        assert!((fit.order.unwrap() - 2.0).abs() < 1e-9, "{fit:?}");
        assert!(fit.points < 9 && fit.rounding_below.is_none());
    }

    #[test]
    fn steps_that_the_results_hold_have_no_order_and_no_number_that_is_none() {
        let held = [(1e-2, 1.4e-6), (1e-2, 1.3e-6), (1e-2, 1.2e-6), (9e-3, 1.1e-6)];
        assert_eq!(fit(&held, 0.0).unwrap().order, None);
        let near = [(1e-2, 1e-6), (8e-3, 6.4e-7), (6e-3, 3.6e-7)];
        assert_eq!(fit(&near, 0.0).unwrap().order, None, "three steps within a factor of two");
    }

    #[test]
    fn scatter_has_no_order() {
        let points = [(1e-2, 1e-3), (5e-3, 9e-4), (2.5e-3, 1e-5), (1.2e-3, 9e-6)];
        assert_eq!(fit(&points, 0.0).unwrap().order, None);
        assert_eq!(fit(&[], 0.0), None);
    }
}
