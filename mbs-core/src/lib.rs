#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
pub mod actions;
pub mod algebra;
pub mod blocks;
#[cfg(feature = "alloc")]
pub mod cluster;
pub mod control;
#[cfg(feature = "alloc")]
pub mod dense;
pub mod effects;
pub mod elements;
#[cfg(feature = "alloc")]
pub mod formulation;
mod forward;
#[cfg(feature = "alloc")]
pub mod history;
#[cfg(feature = "alloc")]
pub mod implicit;
#[cfg(feature = "alloc")]
pub mod inputs;
pub mod integrator;
pub mod laws;
#[cfg(feature = "alloc")]
pub mod model;
#[cfg(feature = "alloc")]
pub mod natural;
pub mod ode;
#[cfg(feature = "alloc")]
pub mod outputs;
pub mod real;
#[cfg(feature = "alloc")]
pub mod refined;
pub mod rigid;
#[cfg(feature = "alloc")]
pub mod saddle;
pub mod scene;
#[cfg(feature = "alloc")]
pub mod start;
pub mod step;
pub mod team;

pub use blocks::{BlockSource, Cliques, FactorError, SpdSolver, SymmetricSolver};
pub use real::Real;
pub use team::{Alone, Team};
