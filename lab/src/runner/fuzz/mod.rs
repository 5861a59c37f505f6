//! Trials of malformed scenes: mutated texts and random mechanisms are read, built and stepped.

pub mod command;
mod mechanism;
mod mutate;
mod table;
mod torn;
pub mod trial;
