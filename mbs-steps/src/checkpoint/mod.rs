//! Checkpoints: everything that the next step depends on, in one file, to resume later with the same bits.
//!
//! ```text
//! "mbs-ckpt" format | length checksum | mbs version | scene, settings | time | state, formulation, control, invariant | record
//! ```
//!
//! [`Simulation::save`] and [`Simulation::restore`] are for programs that step themselves; [`CheckpointWriter`] is how `mbs run` keeps a run,
//! its record among it. docs/CHECKPOINT.md says what is in the file and what is not. The numeric crates give plain histories of
//! what they remember from step to step; the format is here alone.

mod error;
mod file;
mod history;
mod identity;
mod snapshot;
pub mod tape;

pub use crate::kept::{CheckpointWriter, FILE, Head, write_rows};
pub use error::CheckpointError;
pub use file::Checkpoint;

pub use file::{Kind, whole};
pub use identity::Identity;
pub use snapshot::{ControlSnapshot, SimulationSnapshot, inputs};

#[cfg(doc)]
use crate::typed::Simulation;
