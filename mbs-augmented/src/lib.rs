#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod equations;
mod formulation;
mod history;
pub mod index1;
pub mod index3;
mod index_change;
mod inputs;
mod multipliers;
mod newton;
mod options;
mod penalty;
#[doc(hidden)]
pub mod printed;
mod projection;
mod workspace;

pub use formulation::{Augmented, Form};
pub use history::History;
pub use index_change::{ConstraintIndex, IndexChange, IndexHistory};
pub use mbs_core::implicit::{pass_jump, take_inputs};
pub use mbs_core::step::{OptionError, Step, StepError, StepReport, Stop};
pub use options::{Options, Penalty};
pub use workspace::Workspace;
