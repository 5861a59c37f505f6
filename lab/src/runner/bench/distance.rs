//! Relative distance of two solutions.

/// Largest difference of two vectors, relative to the largest component of the first.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(0.0, |most, x| x.abs().max(most));
    let apart = a.iter().zip(b).fold(0.0, |most, (x, y)| (x - y).abs().max(most));
    if size > 0.0 { apart / size } else { apart }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_shares_of_the_largest_number() {
        assert!((distance(&[1.0, -4.0], &[1.0, -3.0]) - 0.25).abs() < 1e-15);
        assert!(distance(&[0.0], &[0.0]).abs() < 1e-15);
    }
}
