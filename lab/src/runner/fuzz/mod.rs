//! Malformed scenes: mutated text and random mechanisms, through reading, building and stepping.

mod command;
mod mechanism;
mod mutate;
mod table;
mod torn;
mod trial;

pub use command::run;
pub use mechanism::mechanism;
pub use mutate::mutated;
pub use table::tables;
pub use torn::torn;

pub use trial::{Verdict, trial};

use torn::damage;

use mbs::scene_file::Dice;

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
