#![doc = include_str!("../README.md")]

mod beside;
pub mod ensemble;
pub mod team;

pub use beside::{apart, beside};
pub use team::{Pool, ThreadTeam, Threads};

/// Most threads of a team: those beyond the processors wait for each other.
#[must_use]
pub fn most_threads() -> usize {
    /// Threads that are allowed on any machine, so that a small one shows what a larger one does. Chosen, not tuned.
    const ALWAYS: usize = 8;
    ensemble::available().get().max(ALWAYS)
}
