//! Random numbers, the same for a seed on every machine for ever: samples of sweeps, and scenes that are made at random.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// Increment: 2^128 over the golden ratio, odd. Seeds, and the parts of one, begin far from each other in the generator's sequence.
const GOLDEN: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;

/// Random numbers, the same for a seed on every machine.
#[derive(Debug)]
pub struct Dice(Pcg64);

impl Dice {
    /// Returns the random numbers of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self::of_part(seed, 0)
    }

    /// Returns the random numbers of a seed's part, which share nothing with other parts.
    pub(crate) fn of_part(seed: u64, part: usize) -> Self {
        let mut random = Pcg64::new(u128::from(seed).wrapping_mul(GOLDEN), 0);
        random.advance((part as u128).wrapping_mul(GOLDEN));
        Self(random)
    }

    /// Returns one of `0..n`; 0 where n is 0.
    pub fn below(&mut self, n: usize) -> usize {
        let n = u64::try_from(n).unwrap_or(u64::MAX).max(1);
        usize::try_from(self.0.next_u64() % n).unwrap_or(0)
    }

    /// One of `0..n` by the upper bits; even to 2^-44 for up to a million.
    #[allow(clippy::cast_possible_truncation, reason = "the upper half of a product is below n")]
    pub(crate) fn evenly_below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.next_u64()) * n as u128) >> 64) as usize
    }

    /// Does it happen, once in n times?
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// A number in [0, 1), a multiple of 2^-53.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are exact")]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * f64::EPSILON / 2.0
    }

    /// A number from a to b.
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// One of a list.
    ///
    /// # Panics
    /// If it is empty.
    pub fn one_of<'a, U>(&mut self, list: &'a [U]) -> &'a U {
        &list[self.below(list.len())]
    }
}
