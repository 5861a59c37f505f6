//! Tests of the import: comparison with other programs on files of about ten lines, and damaged files.

mod collisions;
mod conventions;
mod hostile;
mod motors;
mod pendulum;
mod pictures;
mod weights;
mod worlds;
