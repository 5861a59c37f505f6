//! Random numbers that depend on the seed alone, on every machine. They are for samples of sweeps and for scenes made at random.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Odd increment near 2^128 divided by the golden ratio. It keeps the sequences of different seeds, and of the parts of one seed, far
/// apart.
const GOLDEN: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;

/// A generator of random numbers that depend on the seed alone.
#[derive(Debug)]
pub struct Dice(Pcg64);

impl Dice {
    /// Returns the generator of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self::of_part(seed, 0)
    }

    /// Returns the generator of a part of a seed. The sequences of different parts do not overlap.
    pub(crate) fn of_part(seed: u64, part: usize) -> Self {
        let mut random = Pcg64::new(u128::from(seed).wrapping_mul(GOLDEN), 0);
        random.advance((part as u128).wrapping_mul(GOLDEN));
        Self(random)
    }

    /// Returns a whole number of `0..n`; 0 when n is 0.
    pub fn below(&mut self, n: usize) -> usize {
        let n = u64::try_from(n).unwrap_or(u64::MAX).max(1);
        usize::try_from(self.0.next_u64() % n).unwrap_or(0)
    }

    /// Returns a whole number of `0..n`, computed from the upper bits. The probabilities differ by at most 2^-44 for n up to a million.
    #[allow(clippy::cast_possible_truncation, reason = "the upper half of a product is below n")]
    pub(crate) fn evenly_below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.next_u64()) * n as u128) >> 64) as usize
    }

    /// Returns true with the probability 1/n.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Returns a number in [0, 1), a multiple of 2^-53.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * f64::EPSILON / 2.0
    }

    /// Returns a number from a to b.
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// Returns a random entry of a list.
    ///
    /// # Panics
    /// If the list is empty.
    pub fn one_of<'a, U>(&mut self, list: &'a [U]) -> &'a U {
        &list[self.below(list.len())]
    }
}
