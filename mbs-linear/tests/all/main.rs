//! All tests of this crate in one program, so that the solvers are compiled once. `cargo test -p mbs-linear modes::` runs one module.

mod common;

mod equilibrium;
mod modes;
mod ports;
