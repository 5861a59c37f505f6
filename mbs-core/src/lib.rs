#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
pub mod actions;
#[cfg(feature = "alloc")]
pub mod cluster;
pub mod control;
mod delegate;
pub mod effects;
pub mod elements;
pub mod feedback;
#[cfg(feature = "alloc")]
pub mod formulation;
#[cfg(feature = "alloc")]
pub mod history;
#[cfg(feature = "alloc")]
pub mod implicit;
#[cfg(feature = "alloc")]
pub mod inputs;
pub mod integrator;
pub mod laws;
pub mod measure;
#[cfg(feature = "alloc")]
pub mod model;
#[cfg(feature = "alloc")]
pub mod natural;
#[cfg(feature = "alloc")]
pub mod outputs;
pub mod rigid;
#[cfg(feature = "alloc")]
pub mod saddle;
pub mod scene;
#[cfg(feature = "alloc")]
pub mod start;
pub mod step;

#[cfg(feature = "instances")]
pub use mbs_math::instances;
pub use mbs_math::{
    Alone, BlockSource, Cliques, FactorError, Real, SpdSolver, SymmetricSolver, Team,
};
pub use mbs_math::{algebra, blocks, ode, once, real, team};
#[cfg(feature = "alloc")]
pub use mbs_math::{dense, refined};
