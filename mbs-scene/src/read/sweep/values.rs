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
pub(super) struct Range {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) is_log: bool,
}

impl Range {
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
    pub(super) fn spread(&self, count: u32) -> Vec<f64> {
        let last = f64::from(count.max(2) - 1);
        (0..count).map(|i| self.at(f64::from(i) / last)).collect()
    }

    /// Number of values at a given distance, or nothing where it leads nowhere.
    pub(super) fn steps(&self, step: f64) -> Option<f64> {
        let steps = (self.to - self.from) / step;
        (steps.is_finite() && steps >= 1.0 - ROUNDING).then(|| (steps + ROUNDING).floor() + 1.0)
    }

    /// Numbers at a given distance from the beginning to the end.
    pub(super) fn stepped(&self, step: f64, count: u32) -> Vec<f64> {
        (0..count).map(|i| rounded(self.from + f64::from(i) * step, DIGITS)).collect()
    }

    /// One number in each of `n` strata of equal length, in random order; the same for the same seed and parameter.
    pub(super) fn strata(&self, n: u32, seed: u64, parameter: usize) -> Vec<f64> {
        let mut random = Dice::of_part(seed, parameter);
        let mut order: Vec<u32> = (0..n).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, random.evenly_below(i + 1));
        }
        let strata = order.into_iter();
        strata.map(|k| self.at((f64::from(k) + random.unit()) / f64::from(n))).collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "values are exact decimals")]

    use super::*;

    const fn range(from: f64, to: f64, is_log: bool) -> Range {
        Range { from, to, is_log }
    }

    #[test]
    fn ranges_are_the_decimals_that_a_person_would_write() {
        assert_eq!(
            range(0.0, 1.0, false).spread(11),
            [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
        );
        assert_eq!(range(1e3, 1e7, true).spread(5), [1e3, 1e4, 1e5, 1e6, 1e7]);
        assert_eq!(range(2.0, -2.0, false).spread(3), [2.0, 0.0, -2.0]);
        let tenths = range(0.1, 0.7, false);
        assert_eq!(tenths.steps(0.1), Some(7.0));
        assert_eq!(tenths.stepped(0.1, 7), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
    }

    #[test]
    fn steps_stop_before_the_end_and_lead_nowhere_the_wrong_way() {
        assert_eq!(range(0.0, 1.0, false).steps(0.3), Some(4.0));
        for step in [-0.1, 0.0, 1.1, f64::NAN] {
            assert_eq!(range(0.0, 1.0, false).steps(step), None, "{step}");
        }
    }

    #[test]
    fn every_stratum_has_one_sample() {
        // Strata.
        const N: u32 = 500;
        for stream in 0..3 {
            let samples = range(0.0, f64::from(N), false).strata(N, 42, stream);
            let mut strata: Vec<i64> = samples.iter().map(|x| x.floor() as i64).collect();
            strata.sort_unstable();
            assert!(strata.into_iter().eq(0..i64::from(N)));
        }
    }

    #[test]
    fn logarithmic_strata_are_equal_in_the_logarithm() {
        let samples = range(1.0, 1e8, true).strata(8, 7, 0);
        let mut decades: Vec<i64> = samples.iter().map(|x| x.log10().floor() as i64).collect();
        decades.sort_unstable();
        assert!(decades.into_iter().eq(0..8));
    }

    #[test]
    fn a_seed_gives_the_same_numbers_for_ever() {
        let unit = range(0.0, 1.0, false);
        assert_eq!(unit.strata(4, 1, 0), unit.strata(4, 1, 0));
        assert_ne!(unit.strata(4, 1, 0), unit.strata(4, 1, 1), "parameters differ");
        assert_ne!(unit.strata(4, 1, 0), unit.strata(4, 2, 0), "seeds differ");
        assert_eq!(
            unit.strata(4, 1, 0),
            [0.973670765717351, 0.570366765570404, 0.124901993148397, 0.324573846340744]
        );
    }
}
