#![doc = include_str!("../README.md")]

mod mechanism;
mod mutate;
mod torn;
mod trial;

pub use mechanism::mechanism;
pub use mutate::mutated;
pub use torn::torn;
pub use trial::{Verdict, trial};

use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// 2^128 over the golden ratio, odd: seeds begin far from each other in the generator's sequence.
const GOLDEN: u128 = 0x9E37_79B9_7F4A_7C15_F39C_C060_5CED_C835;

/// Random numbers, the same for a seed on every machine.
#[derive(Debug)]
pub struct Dice(Pcg64);

impl Dice {
    /// Those of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::new(u128::from(seed).wrapping_mul(GOLDEN), 0))
    }

    /// One of `0..n`; 0 where n is 0.
    pub fn below(&mut self, n: usize) -> usize {
        let n = u64::try_from(n).unwrap_or(u64::MAX).max(1);
        usize::try_from(self.0.next_u64() % n).unwrap_or(0)
    }

    /// Does it happen, once in n times?
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// A number from a to b.
    #[allow(clippy::cast_precision_loss, reason = "53 bits are a f64")]
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        let share = (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        a + (b - a) * share
    }

    /// One of a list.
    pub fn one_of<'a, U>(&mut self, list: &'a [U]) -> &'a U {
        &list[self.below(list.len())]
    }
}

/// The scene of a seed: a random mechanism, or one of these with its text mutated.
#[must_use]
pub fn scene(seed: u64, corpus: &[String]) -> String {
    let mut dice = Dice::new(seed);
    match dice.below(4) {
        0 => mechanism(&mut dice),
        1 => {
            let text = mechanism(&mut dice);
            mutated(&text, corpus, &mut dice)
        }
        _ if corpus.is_empty() => mechanism(&mut dice),
        _ => {
            let text = dice.one_of(corpus).clone();
            mutated(&text, corpus, &mut dice)
        }
    }
}
