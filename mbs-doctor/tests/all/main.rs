//! The tests of this crate, in one program: each program would compile the same solvers anew. `cargo test -p mbs-doctor random::` runs one module.

mod support;

mod mechanisms;
mod random;
