//! Random numbers by seed. Every machine draws the same numbers.

use crate::vector::{Vector, norm, scale};

/// A source of random numbers (splitmix64).
#[derive(Debug, Clone)]
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        let mut dice = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x6a75_6467_6521);
        dice.next();
        dice
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Draws a number from the uniform distribution between two numbers.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        // a double represents 53 random bits exactly
        #[allow(clippy::cast_precision_loss, reason = "53 bits")]
        let share = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * share
    }

    /// Draws a positive number whose logarithm is uniformly distributed.
    pub(crate) fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// Draws a whole number of 0..n.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        #[allow(clippy::cast_possible_truncation, reason = "less than n")]
        let i = (self.next() % n as u64) as usize;
        i
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    /// Draws an element of a list by weights.
    pub(crate) fn weighted<T: Copy>(&mut self, list: &[(T, f64)]) -> T {
        let mut left = self.between(0.0, list.iter().map(|x| x.1).sum());
        for (x, weight) in list {
            if left < *weight {
                return *x;
            }
            left -= weight;
        }
        list[list.len() - 1].0
    }

    /// Draws a unit vector, in the plane or in space.
    pub(crate) fn direction(&mut self, planar: bool) -> Vector {
        loop {
            let z = if planar { 0.0 } else { self.between(-1.0, 1.0) };
            let v = [self.between(-1.0, 1.0), self.between(-1.0, 1.0), z];
            let n = norm(v);
            if n > 0.1 && n < 1.0 {
                return scale(1.0 / n, v);
            }
        }
    }
}
