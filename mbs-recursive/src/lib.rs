#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
mod build;
#[cfg(feature = "alloc")]
mod host;
pub mod link;
pub mod loads;
pub mod loops;
#[cfg(feature = "alloc")]
pub mod own;
pub mod passes;
pub mod rows;
pub mod space;
pub mod step;

#[cfg(feature = "alloc")]
pub use build::{CurveTables, LanesError, TreeError, TreeModel};
#[cfg(feature = "alloc")]
pub use host::{
    EffortTerms, History, JointLinks, StartError, Tree, TreeMethod, TreeState, Workspace,
};
pub use link::indexing::Outside;
pub use link::options::{Closure, Options};
pub use mbs_core::step::{OptionError, StepError, StepReport, Stop};
pub use space::{Planar, Spatial};
