//! The values of a parameter: ranges, and samples of a Latin hypercube.
//!
//! ```text
//! linear        x(s) = a + (b − a) s                       s in [0, 1]
//! logarithmic   x(s) = 10^(lg a + (lg b − lg a) s)
//! range         s = i / (n − 1),   i = 0 .. n − 1
//! hypercube     s = (p(i) + u(i)) / n,   p a permutation of 0 .. n − 1, u in [0, 1)
//! ```
//!
//! Computed values are rounded to 15 digits. A tenth is then 0.1, and all machines give the same text.

use crate::dice::Dice;
use crate::format::rounded;

/// Significant digits to which values are rounded [-]. Every decimal text of 15 digits survives the conversion to `f64`.
const DIGITS: usize = 15;
/// Fraction of a step by which a range may miss its end, due to the rounding of decimals [-]. Chosen, not tuned.
const ROUNDING: f64 = 1e-9;

/// Range of numbers between two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueRange {
    /// First number of the range.
    pub from: f64,
    /// Last number of the range.
    pub to: f64,
    /// True if the logarithms of the values are at equal distances.
    pub is_log: bool,
}

impl ValueRange {
    /// The number at a fraction of the range, from 0 to 1. The ends are exact.
    fn at(&self, share: f64) -> f64 {
        let Self { from, to, is_log } = *self;
        if share <= 0.0 || share >= 1.0 {
            return if share <= 0.0 { from } else { to };
        }
        if is_log {
            let (a, b) = (libm::log10(from), libm::log10(to));
            return rounded(libm::exp10(a + (b - a) * share), DIGITS);
        }
        rounded(from + (to - from) * share, DIGITS)
    }

    /// Numbers at equal distances, with both ends; `count` is at least 2. A logarithmic range has equal distances in the logarithm.
    pub fn spread(&self, count: u32) -> Vec<f64> {
        let last = f64::from(count.max(2) - 1);
        (0..count).map(|i| self.at(f64::from(i) / last)).collect()
    }

    /// Number of values at a given distance. `None` when the step leads away from the end of the range.
    pub fn steps(&self, step: f64) -> Option<f64> {
        let steps = (self.to - self.from) / step;
        (steps.is_finite() && steps >= 1.0 - ROUNDING).then(|| (steps + ROUNDING).floor() + 1.0)
    }

    /// Numbers at a given distance, from the beginning of the range on.
    pub fn stepped(&self, step: f64, count: u32) -> Vec<f64> {
        (0..count).map(|i| rounded(self.from + f64::from(i) * step, DIGITS)).collect()
    }

    /// One number in each of `n` intervals of equal length, in random order. The numbers depend on the seed and the index of the parameter
    /// alone.
    pub fn strata(&self, n: u32, seed: u64, parameter: usize) -> Vec<f64> {
        let mut random = Dice::of_part(seed, parameter);
        let mut order: Vec<u32> = (0..n).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, random.evenly_below(i + 1));
        }
        let strata = order.into_iter();
        strata.map(|k| self.at((f64::from(k) + random.unit()) / f64::from(n))).collect()
    }
}
