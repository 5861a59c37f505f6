#![doc = include_str!("../README.md")]

mod beside;
pub mod ensemble;
pub mod team;

pub use beside::{apart, beside};
pub use team::{Pool, ThreadTeam, Threads};

/// Returns the largest allowed number of threads of a team. More threads than processors would wait for each other.
#[must_use]
pub fn most_threads() -> usize {
    /// Number of threads that is allowed on every machine. So the settings of a large machine can also run on a small one. Chosen, not
    /// tuned.
    const ALWAYS: usize = 8;
    ensemble::available().get().max(ALWAYS)
}
