//! Files of a run that is kept while it goes: its checkpoint, its rows and its steps.

mod rows;
mod writer;

pub use rows::{Head, write_rows};
pub use writer::{CheckpointWriter, FILE};
