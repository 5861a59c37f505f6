//! Steps of mechanisms in a process that a job can watch: timed, tried on malformed scenes, or judged on hard cases.
#![cfg(feature = "runner")]

pub mod bench;
pub mod fuzz;
pub mod gauntlet;
