//! Runs of mechanisms in a process that a job starts and supervises: benchmarks, trials of malformed scenes, difficult cases.
#![cfg(feature = "runner")]

pub mod bench;
pub mod fuzz;
pub mod gauntlet;
