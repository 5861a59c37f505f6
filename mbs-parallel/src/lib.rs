#![doc = include_str!("../README.md")]

pub mod ensemble;
pub mod team;

pub use team::{Pool, ThreadTeam, Threads};

/// Threads that are of use at most: those beyond the processors wait for each other. A few more are let be, so that a small machine can
/// show what a larger one does.
#[must_use]
pub fn most_threads() -> usize {
    const FEW: usize = 8;
    ensemble::available().get().max(FEW)
}
