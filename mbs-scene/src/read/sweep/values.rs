//! The values of a parameter: ranges, and samples of a Latin hypercube.
//!
//! ```text
//! linear        x(s) = a + (b − a) s                       s in [0, 1]
//! logarithmic   x(s) = 10^(lg a + (lg b − lg a) s)
//! range         s = i / (n − 1),   i = 0 .. n − 1
//! hypercube     s = (p(i) + u(i)) / n,   p a permutation of 0 .. n − 1, u in [0, 1)
//! ```
//!
//! Computed values are rounded to 15 digits, so that a tenth is 0.1 and no machine's last bit shows.

use crate::dice::Dice;
use crate::format::rounded;

/// Significant digits of computed values: what every decimal text keeps through `f64`.
const DIGITS: usize = 15;
/// Fraction of a step by which a range may miss its end [-]: decimals are rounded. Chosen, not tuned.
const ROUNDING: f64 = 1e-9;

/// Numbers between two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueRange {
    /// First number of the range.
    pub from: f64,
    /// Last number of the range.
    pub to: f64,
    /// Are distances equal in the logarithm?
    pub is_log: bool,
}

impl ValueRange {
    /// The number at a share of the range; the ends are exact.
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

    /// `count` numbers at equal distances (in the logarithm, for a logarithmic range), both ends included; `count` >= 2.
    pub fn spread(&self, count: u32) -> Vec<f64> {
        let last = f64::from(count.max(2) - 1);
        (0..count).map(|i| self.at(f64::from(i) / last)).collect()
    }

    /// Number of values at a given distance, or nothing where it leads nowhere.
    pub fn steps(&self, step: f64) -> Option<f64> {
        let steps = (self.to - self.from) / step;
        (steps.is_finite() && steps >= 1.0 - ROUNDING).then(|| (steps + ROUNDING).floor() + 1.0)
    }

    /// Numbers at a given distance from the beginning to the end.
    pub fn stepped(&self, step: f64, count: u32) -> Vec<f64> {
        (0..count).map(|i| rounded(self.from + f64::from(i) * step, DIGITS)).collect()
    }

    /// One number in each of `n` strata of equal length, in random order; the same for the same seed and parameter.
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
