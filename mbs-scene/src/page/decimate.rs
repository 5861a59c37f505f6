//! Thinning of series so that peaks survive, and rounding of numbers for compact pages.

/// Most points of a line.
pub(super) const MOST: usize = 1500;

/// Indices to keep: the first, the last, and the smallest and largest value of each of `MOST/2 - 1` stretches.
///
/// Values that are not finite are kept once per stretch, so that gaps survive too. Cost: one pass.
pub(super) fn kept(values: &[f64]) -> Vec<usize> {
    if values.len() <= MOST {
        return (0..values.len()).collect();
    }
    // three indices at most per stretch: smallest, largest, first gap; and the two ends
    let has_gaps = values.iter().any(|x| !x.is_finite());
    let n_stretches = (MOST - 2) / if has_gaps { 3 } else { 2 };
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

/// Evenly spread indices, the first and the last among them.
pub(super) fn spread(n: usize) -> Vec<usize> {
    if n <= MOST {
        return (0..n).collect();
    }
    (0..MOST).map(|i| i * (n - 1) / (MOST - 1)).collect()
}

/// Rounds to so many significant digits, which shortens the decimal text.
pub(super) fn rounded(x: f64, digits: usize) -> f64 {
    if !x.is_finite() {
        return x;
    }
    format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_peaks_and_gaps_survive() {
        let mut values = vec![0.0; 100_000];
        values[31_415] = 7.0;
        values[27_182] = -3.0;
        let indices = kept(&values);
        assert!(indices.len() <= MOST);
        assert!(indices.contains(&31_415) && indices.contains(&27_182));
        assert!(indices.starts_with(&[0]) && indices.ends_with(&[99_999]));
        values[5] = f64::NAN;
        let indices = kept(&values);
        assert!(indices.len() <= MOST && indices.contains(&5) && indices.contains(&31_415));
    }

    #[test]
    fn short_series_are_kept_whole() {
        assert_eq!(kept(&[1.0, 2.0, 3.0]), [0, 1, 2]);
        assert_eq!(spread(3), [0, 1, 2]);
        let indices = spread(10_000);
        assert_eq!((indices.len(), indices[0], indices[MOST - 1]), (MOST, 0, 9_999));
    }

    #[test]
    fn rounding_keeps_leading_digits() {
        assert_eq!(rounded(123_456.789, 4).to_bits(), 123_500.0_f64.to_bits());
        assert!(rounded(f64::NAN, 4).is_nan());
    }
}
