//! placeholder
#![no_std]

extern crate alloc;

mod basis;
mod chart;
mod dense;
pub mod elimination;
mod jacobian;
mod options;
mod place;
mod step;
mod workspace;

pub use mbs_core::step::{OptionError, StepError, StepReport, Stop};
pub use options::{ChoiceOf, Coordinates, Options};
pub use step::step;
pub use workspace::Workspace;
