#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

pub mod index1;
pub mod index3;
mod inputs;
mod options;
mod projection;
mod workspace;

pub use inputs::take_inputs;
pub use mbs_core::saddle::Saddle;
pub use mbs_core::step::{OptionError, StepError, StepReport, Stop};
pub use options::{Options, Stabilisation};
pub use workspace::Workspace;
