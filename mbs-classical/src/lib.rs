#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod formulation;
pub mod index1;
pub mod index3;
mod inputs;
mod options;
mod projection;
mod workspace;

pub use formulation::Classical;
pub use mbs_core::implicit::{pass_jump, take_inputs};
pub use mbs_core::saddle::Saddle;
pub use mbs_core::step::{OptionError, Step, StepError, StepReport, Stop};
pub use options::{Options, Stabilisation};
pub use workspace::Workspace;
