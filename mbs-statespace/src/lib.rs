#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod basis;
mod chart;
mod dense;
pub mod elimination;
mod formulation;
mod history;
mod inputs;
mod jacobian;
mod options;
mod pivots;
mod place;
mod step;
mod workspace;

pub use formulation::StateSpace;
pub use history::History;
pub use mbs_core::implicit::{pass_jump, take_inputs};
pub use mbs_core::step::{OptionError, Step, StepError, StepReport, Stop};
pub use options::{Coordinates, Options, PivotChange};
pub use step::step;
pub use workspace::Workspace;
