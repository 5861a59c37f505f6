#![doc = include_str!("../README.md")]
#![no_std]

extern crate alloc;

mod formulation;
mod history;
pub mod index1;
pub mod index3;
mod index_change;
mod inputs;
mod multi_index;
mod nearby;
mod options;
mod pace;
mod projection;
mod workspace;

pub use formulation::{Augmented, Form};
pub use history::{History, IndexHistory};
pub use index_change::{ConstraintIndex, IndexChange};
pub use inputs::take_inputs;
pub use mbs_core::step::{OptionError, Step, StepError, StepReport, Stop};
pub use multi_index::MultiIndex;
pub use options::{Multipliers, Options, Penalty, Projection};
pub use workspace::Workspace;
