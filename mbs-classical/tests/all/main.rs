//! All tests of this crate in one program, so that the solvers are compiled once. `cargo test -p mbs-classical cross::` runs one module.

mod common;

mod allocation;
mod analytic;
mod cross;
