//! Helpers for the tests of several crates: scenes with their initial states, dense views of a model, random mechanisms, equivalent forms of
//! mechanisms, and a counting allocator. They are compiled once, for double precision, so that no test program compiles them again.

pub mod allocations;
mod dense;
pub mod effects;
pub mod machines;
pub mod quantities;
pub mod random;
pub mod repository;
pub mod retell;
pub mod scenes;
mod start;

pub use dense::{
    apart, close, dot, in_null_space, jacobian, matrix, plus, rates, reference, residual,
};
pub use random::Random;
pub use scenes::{PLANAR, SPATIAL, file, file_in, scene, scene_in};
pub use start::{
    START_IN_PLANE, START_IN_SPACE, centres, invariant, model, named_centres, solver, start,
    start_in,
};
