//! The tests of this crate, in one program: each program would compile the same solvers anew. `cargo test -p mbs-statespace motion::` runs one module.

mod common;

mod allocation;
mod elimination;
mod invariants;
mod motion;
