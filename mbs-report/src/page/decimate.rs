//! Thinning of series, in which the peaks remain.

/// Largest number of points of a line [-]. A screen has fewer columns for a line.
pub(super) const MAX_POINTS: usize = 1500;

/// Returns the indices of at most `most` points to keep. They are the first, the last, and the smallest and largest value in each of
/// `most/2 - 1` intervals.
///
/// In each interval one value that is not finite is also kept, so that gaps remain visible. Cost: one pass.
pub(super) fn kept(values: &[f64], most: usize) -> Vec<usize> {
    if values.len() <= most {
        return (0..values.len()).collect();
    }
    // at most three indices per interval (smallest, largest, first gap), and the two ends
    let has_gaps = values.iter().any(|x| !x.is_finite());
    let n_stretches = most.saturating_sub(2).max(3) / if has_gaps { 3 } else { 2 };
    let mut indices = vec![0];
    for stretch in 0..n_stretches {
        let start = stretch * values.len() / n_stretches;
        let end = (stretch + 1) * values.len() / n_stretches;
        let finite = || (start..end).filter(|i| values[*i].is_finite());
        indices.extend(finite().min_by(|i, j| values[*i].total_cmp(&values[*j])));
        indices.extend(finite().max_by(|i, j| values[*i].total_cmp(&values[*j])));
        indices.extend((start..end).find(|i| !values[*i].is_finite()));
    }
    indices.push(values.len() - 1);
    indices.sort_unstable();
    indices.dedup();
    indices
}

/// Number of intervals of an upper envelope [-]. Chosen, not tuned.
const EDGE: usize = 240;

/// Returns the indices of the first value, of the largest value in each of 240 intervals, and of the last value.
pub(super) fn envelope(values: &[f64]) -> Vec<usize> {
    if values.len() <= EDGE {
        return (0..values.len()).collect();
    }
    let mut indices = vec![0];
    for stretch in 0..EDGE {
        let range = stretch * values.len() / EDGE..(stretch + 1) * values.len() / EDGE;
        indices.extend(range.max_by(|i, j| values[*i].total_cmp(&values[*j])));
    }
    indices.push(values.len() - 1);
    indices.dedup();
    indices
}

/// Returns at most `most` evenly distributed indices, including the first and the last.
pub(super) fn spread(n: usize, most: usize) -> Vec<usize> {
    let most = most.max(2);
    if n <= most {
        return (0..n).collect();
    }
    (0..most).map(|i| i * (n - 1) / (most - 1)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_peaks_and_gaps_survive() {
        let mut values = vec![0.0; 100_000];
        values[31_415] = 7.0;
        values[27_182] = -3.0;
        let indices = kept(&values, MAX_POINTS);
        assert!(indices.len() <= MAX_POINTS);
        assert!(indices.contains(&31_415) && indices.contains(&27_182));
        assert!(indices.starts_with(&[0]) && indices.ends_with(&[99_999]));
        values[5] = f64::NAN;
        let indices = kept(&values, MAX_POINTS);
        assert!(indices.len() <= MAX_POINTS && indices.contains(&5) && indices.contains(&31_415));
    }

    #[test]
    fn the_upper_edge_keeps_every_peak_and_drops_the_dips() {
        let mut values: Vec<f64> = (0..24_000).map(|i| f64::from(i % 7)).collect();
        values[12_345] = 9.0;
        let indices = envelope(&values);
        assert!(indices.len() <= EDGE + 2 && indices.contains(&12_345));
        let inner = &indices[1..indices.len() - 1];
        assert!(inner.iter().all(|i| values[*i] >= 6.0));
    }

    #[test]
    fn short_series_are_kept_whole() {
        assert_eq!(kept(&[1.0, 2.0, 3.0], MAX_POINTS), [0, 1, 2]);
        assert_eq!(spread(3, MAX_POINTS), [0, 1, 2]);
        let indices = spread(10_000, MAX_POINTS);
        assert_eq!((indices.len(), indices[0], indices[MAX_POINTS - 1]), (MAX_POINTS, 0, 9_999));
    }
}
