//! All tests of this crate in one program, so that the solvers are compiled once. `cargo test -p mbs-sparse tasks::` runs one module.

mod common;

mod allocation;
mod delays;
mod failures;
mod indefinite;
mod reference;
mod refined;
mod structure;
mod tasks;
