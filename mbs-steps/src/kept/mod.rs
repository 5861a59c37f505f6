//! Files that are written during a run: its checkpoint, its rows and its steps.

mod rows;
mod writer;

pub use rows::{Head, write_rows};
pub use writer::{CheckpointWriter, FILE};
