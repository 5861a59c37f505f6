#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod blocks;
pub mod laws;
pub mod real;
#[cfg(feature = "alloc")]
pub mod scene;

pub use blocks::{BlockSource, Cliques, FactorError, SpdSolver};
pub use real::Real;
