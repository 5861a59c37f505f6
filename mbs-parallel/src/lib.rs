#![doc = include_str!("../README.md")]

pub mod ensemble;
pub mod team;

pub use mbs_sparse::{Multifrontal, Options as SparseOptions, Ordering};
pub use team::{Crew, Pool, Threads};
