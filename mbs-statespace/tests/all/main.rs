//! All tests of this crate in one program, so that the solvers are compiled once. `cargo test -p mbs-statespace motion::` runs one module.

mod common;

mod allocation;
mod elimination;
mod invariants;
mod motion;
