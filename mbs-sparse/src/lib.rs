#![doc = include_str!("../README.md")]

mod delayed;
mod dissection;
mod front;
mod graph;
mod indefinite;
mod kernel;
mod multifrontal;
mod options;
mod part;
mod pivoting;
mod plan;
mod scatter;
mod subtree;
mod sweep;
mod tasks;
mod tree;

pub use delayed::Delays;
pub use indefinite::Indefinite;
pub use multifrontal::Multifrontal;
pub use options::{Counters, Options, Ordering, Pivoting};

pub use mbs_math::{
    Alone, BlockSource, Cliques, FactorError, Real, SpdSolver, SymmetricSolver, Team,
};
