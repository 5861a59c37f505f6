#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "alloc")]
mod angles;
#[cfg(feature = "alloc")]
mod build;
#[cfg(feature = "alloc")]
mod formulation;
#[cfg(feature = "alloc")]
mod history;
#[cfg(feature = "alloc")]
mod lanes;
pub mod link;
pub mod loads;
pub mod loops;
#[cfg(feature = "alloc")]
pub mod own;
pub mod passes;
#[cfg(feature = "alloc")]
mod quantities;
pub mod rows;
#[cfg(feature = "alloc")]
mod run;
pub mod space;
#[cfg(feature = "alloc")]
mod start;
#[cfg(feature = "alloc")]
mod state;
pub mod step;
#[cfg(feature = "alloc")]
mod turns;
#[cfg(feature = "alloc")]
mod under_efforts;

#[cfg(feature = "alloc")]
pub use build::{CurveTables, LanesError, TreeError, TreeModel};
#[cfg(feature = "alloc")]
pub use formulation::{Tree, TreeStep};
#[cfg(feature = "alloc")]
pub use history::History;
pub use link::indexing::Outside;
pub use link::options::{Closure, Options};
pub use mbs_core::step::{OptionError, StepError, StepReport, Stop};
#[cfg(feature = "alloc")]
pub use quantities::{EffortTerms, JointLinks};
#[cfg(feature = "alloc")]
pub use run::{
    bounded_step, extrapolated_step, radau5_step, rk4_step, rk54_step, rk853_step, step,
};
pub use space::{Planar, Spatial};
#[cfg(feature = "alloc")]
pub use start::StartError;
#[cfg(feature = "alloc")]
pub use state::{TreeState, Workspace};
