//! The tests of this crate, in one program: each program would compile the same solvers anew. `cargo test -p mbs-core start::` runs one module.

mod gradient;
mod small;

mod axes;
mod balls;
mod codes;
mod coupling_kinds;
mod effect_table;
mod effects;
mod efforts;
mod elements;
mod events;
mod joints;
mod least;
mod model;
mod motion;
mod moved_mass;
mod outputs;
mod quantities;
mod reactions;
mod relative;
mod signals;
mod start;
mod sums;
mod undetermined;
