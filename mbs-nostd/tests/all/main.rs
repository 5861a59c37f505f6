//! The tests of this crate as one program, because several programs would compile the same solvers several times.
//! `cargo test -p mbs-nostd operation_bound::` runs one module.

mod support;

mod agreement;
mod inputs;
mod observer;
mod operation_bound;
mod ropes_and_cams;
mod set_state;
mod signals;
