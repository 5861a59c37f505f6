#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod algebra;
pub mod blocks;
#[cfg(feature = "alloc")]
pub mod dense;
pub mod entry;
pub mod ode;
pub mod once;
pub mod real;
#[cfg(feature = "alloc")]
pub mod refined;
pub mod team;

pub use blocks::{BlockSource, Cliques, FactorError, SpdSolver, SymmetricSolver};
pub use real::Real;
pub use team::{Alone, Team};
