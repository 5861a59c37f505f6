//! Checkpoints: files with all data that the next step depends on. A resumed run is bitwise the same as an uninterrupted one.
//!
//! ```text
//! "mbs-ckpt" format | length checksum | mbs version | scene, settings | time | state, formulation, control, invariant | record
//! ```
//!
//! [`Simulation::save`] and [`Simulation::restore`] are for programs that make the steps themselves. `mbs run` saves a run and its record
//! with [`CheckpointWriter`]. docs/CHECKPOINT.md describes the content of the file. The numerical crates return their stored values as
//! plain data; only this module defines the file format.

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
