//! All tests of this crate in one program, so that the solvers are compiled once. `cargo test -p mbs-augmented invariants::` runs one module.

mod allocation;
mod double_double;
mod inputs;
mod invariants;
mod multi_index;
mod printed;
mod strategies;
