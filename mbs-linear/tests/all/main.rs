//! The tests of this crate, in one program: each program would compile the same solvers anew. `cargo test -p mbs-linear modes::` runs one module.

mod common;

mod equilibrium;
mod modes;
mod ports;
