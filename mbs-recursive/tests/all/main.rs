//! The tests of this crate as one program, because several programs would compile the same solvers several times.
//! `cargo test -p mbs-recursive stiff::` runs one module.

mod support;

mod agreement;
mod couplings;
mod derivatives;
mod double_double;
mod effects;
mod inverse;
mod lanes;
mod motion;
mod stiff;
mod tangent;
