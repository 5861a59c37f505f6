//! The tests of this crate, in one program.

mod double_double;
mod eighth;
mod extrapolation;
