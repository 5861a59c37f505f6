#![doc = include_str!("../README.md")]
#![allow(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]

pub mod auto;
pub mod compare;
pub mod doctor;
mod error;
pub mod estimate;
pub mod explain;
mod front;
mod journal;
pub mod redundancy;
pub mod sweep;

pub use compare::Request as Compare;
pub use front::{Sweep, SweepResult, compare, sweep};
