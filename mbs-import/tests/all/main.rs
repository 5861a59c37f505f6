//! The reader beside other programs, on files of ten lines each, and on damaged ones.

mod collisions;
mod conventions;
mod hostile;
mod motors;
mod pendulum;
mod pictures;
mod weights;
mod worlds;
