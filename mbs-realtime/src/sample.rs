//! Sample of the times of an endless run in bounded memory, and its percentiles.
//!
//! ```text
//! percentile p of n sorted values: the one with index ⌊(n − 1) p / 100⌋
//! ```

use std::time::Duration;

/// Largest number of stored values: half a megabyte. Percentiles of runs up to this length are exact.
const CAPACITY: usize = 1 << 16;

/// Returns a percentile of n ascending values: the value with index ⌊(n − 1) percent / 100⌋. Returns `None` if there are no values.
#[must_use]
pub fn nearest_rank<T>(sorted: &[T], percent: usize) -> Option<&T> {
    sorted.get(sorted.len().checked_sub(1)? * percent.min(100) / 100)
}

/// Sample of times [ns]: all times up to the capacity, then every second one, then every fourth, and so on.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    kept: Vec<i64>,
    /// Distance of two stored values in the series of all values [-].
    every: u64,
    seen: u64,
    range: Option<[i64; 2]>,
}

impl Sample {
    pub(crate) fn new() -> Self {
        Self { kept: Vec::with_capacity(CAPACITY), every: 1, seen: 0, range: None }
    }

    /// Adds a value without allocation.
    pub(crate) fn take(&mut self, value: i64) {
        let [least, most] = self.range.unwrap_or([value; 2]);
        self.range = Some([least.min(value), most.max(value)]);
        if self.seen.is_multiple_of(self.every) {
            if self.kept.len() == CAPACITY {
                self.thin();
            }
            if self.seen.is_multiple_of(self.every) {
                self.kept.push(value);
            }
        }
        self.seen += 1;
    }

    /// Drops every second value, but not the first one.
    fn thin(&mut self) {
        for i in 0..CAPACITY / 2 {
            self.kept[i] = self.kept[2 * i];
        }
        self.kept.truncate(CAPACITY / 2);
        self.every *= 2;
    }

    /// Returns the stored values in ascending order, and the least and largest of all values.
    pub(crate) fn sorted(&self) -> Option<(Vec<i64>, [i64; 2])> {
        let mut sorted = self.kept.clone();
        sorted.sort_unstable();
        Some((sorted, self.range?))
    }
}

/// Converts a time to nanoseconds. The largest time is about three hundred years.
pub(crate) fn nanos(time: Duration) -> i64 {
    i64::try_from(time.as_nanos()).unwrap_or(i64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_percentile_is_one_of_the_values() {
        let values: Vec<u32> = (1..=200).collect();
        let of = |percent| nearest_rank(&values, percent).copied();
        assert_eq!([of(0), of(50), of(99), of(100)], [Some(1), Some(100), Some(198), Some(200)]);
        assert_eq!((nearest_rank(&[7], 99), nearest_rank::<u8>(&[], 50)), (Some(&7), None));
    }

    #[test]
    fn many_values_are_thinned_evenly_and_extremes_stay_exact() {
        let mut sample = Sample::new();
        let n = 5 * CAPACITY as i64;
        for value in 0..n {
            // A permutation in which the order of the values does not depend on their size.
            sample.take((value * 1_000_003) % n);
        }
        let (sorted, range) = sample.sorted().expect("there are values");
        assert_eq!(range, [0, n - 1]);
        assert!(sorted.len() <= CAPACITY && sorted.len() > CAPACITY / 4);
        // The sample has about 40,000 values at regular distances. Its median differs from that of all values by less than a hundredth.
        let median = nearest_rank(&sorted, 50).expect("there are values");
        assert!((median - n / 2).abs() < n / 100, "{median} of {n}");
    }
}
