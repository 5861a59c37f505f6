#![doc = include_str!("../README.md")]
#![no_std]

#[cfg(feature = "export")]
extern crate alloc;

mod check;
mod elements;
#[cfg(feature = "export")]
pub mod export;
pub mod format;
mod inputs;
mod ladder;
mod model;
pub mod operation_bound;
mod solver;
mod state_error;
pub mod table;
mod tables;

pub use check::{Checked, LoadError, Sizes};
pub use inputs::{Motion, Prescriptions, Rise, SignalLaw, Values};
pub use ladder::DegradationLadder;
pub use mbs_core::Real;
pub use mbs_core::step::{InputError, StepError};
pub use mbs_recursive::step::bounded::{BoundedReport, Bounds, Unwatched, Watch};
pub use mbs_recursive::step::set_state::StateReport;
pub use mbs_recursive::{Options, Planar, Spatial};
pub use model::{Model, StartState};
pub use solver::Solver;
pub use state_error::StateError;
pub use tables::Tables;
