//! Evaluation of points: slopes, interpolated numbers, ranks, and checks whether errors decrease.

pub(crate) use crate::format::span;

/// Slope of log y over log x by least squares; `None` for fewer than two points.
pub(crate) fn slope(points: &[[f64; 2]]) -> Option<f64> {
    power(points).map(|power| power[0])
}

/// Value of y at x by the power law that fits the points best.
pub(crate) fn continued(points: &[[f64; 2]], x: f64) -> Option<f64> {
    power(points).map(|[slope, one]| (one + slope * x.ln()).exp())
}

/// Slope of log y over log x by least squares, and log y at x = 1; `None` for fewer than two points.
fn power(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let logs: Vec<_> = points.iter().filter(is_positive).map(|p| p.map(f64::ln)).collect();
    let n = count(logs.len());
    let mean = |i: usize| logs.iter().map(|p| p[i]).sum::<f64>() / n;
    let (x, y) = (mean(0), mean(1));
    let (above, below) = logs.iter().fold((0.0, 0.0), |(above, below), p| {
        (above + (p[0] - x) * (p[1] - y), below + (p[0] - x) * (p[0] - x))
    });
    let slope = above / below;
    (below > 0.0).then_some([slope, y - slope * x])
}

/// Value of y at x, interpolated between the two nearest points by logarithms; `None` outside the points. They may be in any order.
pub(crate) fn between(points: &[[f64; 2]], x: f64) -> Option<f64> {
    let mut sorted: Vec<_> = points.iter().filter(is_positive).copied().collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let pair = sorted.windows(2).find(|pair| pair[0][0] <= x && x <= pair[1][0])?;
    let [[x0, y0], [x1, y1]] = [pair[0], pair[1]].map(|p| p.map(f64::ln));
    let share = if x1 > x0 { (x.ln() - x0) / (x1 - x0) } else { 0.0 };
    Some((y0 + share * (y1 - y0)).exp())
}

/// The median of numbers, the upper one of an even number; `None` without numbers.
pub(crate) fn median(mut numbers: Vec<f64>) -> Option<f64> {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied()
}

/// Rank correlation of pairs: 1 if both always increase together, -1 if one always decreases while the other increases.
pub(crate) fn rank_correlation(pairs: &[[f64; 2]]) -> Option<f64> {
    let ranks = [0, 1].map(|i| ranks(&pairs.iter().map(|p| p[i]).collect::<Vec<_>>()));
    let middle = 0.5 * (count(pairs.len()) - 1.0);
    let sum = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum()
    };
    let scale = (sum(&ranks[0], &ranks[0]) * sum(&ranks[1], &ranks[1])).sqrt();
    (scale > 0.0).then(|| sum(&ranks[0], &ranks[1]) / scale)
}

/// The rank of each number. Equal numbers get the mean of their ranks.
fn ranks(numbers: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    let mut ranks = vec![0.0; numbers.len()];
    let mut first = 0;
    for same in order.chunk_by(|&a, &b| numbers[a].total_cmp(&numbers[b]).is_eq()) {
        let rank = count(first) + 0.5 * (count(same.len()) - 1.0);
        same.iter().for_each(|&i| ranks[i] = rank);
        first += same.len();
    }
    ranks
}

/// Tolerances at which the error is more than twice that at the next larger tolerance. The points (tolerance, error) begin with the largest
/// tolerance. Errors below the floor are rounding errors, and are not evaluated.
pub(crate) fn rises(points: &[[f64; 2]], floor: f64) -> Vec<f64> {
    let is_rise = |pair: &&[[f64; 2]]| pair[1][1] > floor && pair[1][1] > 2.0 * pair[0][1];
    points.windows(2).filter(is_rise).map(|pair| pair[1][0]).collect()
}

fn is_positive(point: &&[f64; 2]) -> bool {
    point.iter().all(|x| x.is_finite() && *x > 0.0)
}

/// Converts a count to a floating-point number.
fn count(n: usize) -> f64 {
    f64::from(u32::try_from(n).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest error of a fit to exact numbers [-]: some hundred rounding errors.
    const CLOSE: f64 = 1e-12;

    fn is_close(x: Option<f64>, y: f64) -> bool {
        x.is_some_and(|x| (x - y).abs() < CLOSE)
    }

    #[test]
    fn a_power_has_its_slope() {
        let square = [1.0, 2.0, 3.0, 5.0].map(|x: f64| [x, 3.0 * x * x]);
        assert!(is_close(slope(&square), 2.0));
        assert!(is_close(between(&square, 4.0), 48.0));
        assert_eq!(between(&square, 6.0), None);
        assert!(continued(&square, 6.0).is_some_and(|y| (y - 108.0).abs() < 1e-9));
        assert_eq!((slope(&[]), slope(&square[..1])), (None, None));
    }

    #[test]
    fn ranks_agree_whatever_the_numbers() {
        let cube = [-3.0, 7.0, 1.0, 2.0].map(|x: f64| [x, x * x * x]);
        assert!(is_close(rank_correlation(&cube), 1.0));
        assert!(is_close(rank_correlation(&cube.map(|[x, y]| [x, -y])), -1.0));
        assert!(is_close(rank_correlation(&[[1.0, 1.0], [1.0, 2.0], [2.0, 3.0]]), 0.75_f64.sqrt()));
        assert_eq!(rank_correlation(&[[1.0, 1.0], [2.0, 1.0]]), None);
    }

    #[test]
    fn a_rise_is_more_than_twice_and_above_rounding() {
        let errors =
            [[1e-3, 1.0], [1e-4, 1.9], [1e-5, 1e-6], [1e-6, 3e-6], [1e-7, 1e-9], [1e-8, 1e-8]];
        assert_eq!(rises(&errors, 1e-7), [1e-6]);
    }

    #[test]
    fn middle_and_ends() {
        assert!(is_close(median(vec![3.0, 1.0, 2.0]), 2.0));
        assert_eq!((median(vec![]), span([])), (None, None));
        assert_eq!(span([2.0, -1.0, 0.5]), Some([-1.0, 2.0]));
    }
}
