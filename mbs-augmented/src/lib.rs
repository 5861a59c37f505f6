#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod error;
pub mod index1;
pub mod index3;
mod options;
mod projection;
mod workspace;

pub use error::{OptionError, StepError};
pub use options::{Multipliers, Options, Penalty, Projection};
pub use workspace::{StepReport, Stop, Workspace};
